#include "server/document/particle_answer.h"

#include <algorithm>
#include <string_view>

#include "core/scene/check_ranges.h"

namespace awan {
namespace {

bool take_text(TextCursor& c, std::string_view wanted) {
    if (static_cast<std::size_t>(c.end - c.at) < wanted.size() ||
        std::string_view(c.at, wanted.size()) != wanted)
        return false;
    c.at += wanted.size();
    return true;
}

bool take_vector(TextCursor& c, glm::dvec3& to) {
    std::array<double, 3> values{};
    if (!json_runs::take_element(c, values)) return false;
    to = {values[0], values[1], values[2]};
    return true;
}

}  // namespace

Result<Cloud> cloud_of(const ParticleAnswer& answer) {
    Cloud cloud;
    cloud.model = CloudModel::kParticles;
    // An answer holds extinction itself.
    cloud.density = 1.0;
    ReadyParticles& ready = cloud.ready;
    ready.positions.reserve(answer.particles.size());
    ready.radii.reserve(answer.particles.size());
    ready.densities.reserve(answer.particles.size());
    bool all_white = true;
    for (std::size_t i = 0; i < answer.particles.size(); ++i) {
        const AnsweredParticle& particle = answer.particles[i];
        if (Status wrong = check_ranges(kAnsweredParticleTable, &particle, "")) {
            wrong->pointer = "/particles/" + std::to_string(i) + wrong->pointer;
            return *wrong;
        }
        ready.positions.push_back(particle.center);
        ready.radii.push_back(static_cast<float>(particle.radius));
        ready.densities.push_back(static_cast<float>(particle.density));
        all_white = all_white && particle.color == glm::dvec3(1);
    }
    if (!all_white)
        for (const AnsweredParticle& particle : answer.particles)
            ready.colors.emplace_back(particle.color);
    return cloud;
}

AnswerInScene::Key AnswerInScene::key(std::string_view name) {
    if (name == "particles" && !is_there_) {
        is_there_ = true;
        return Key::kParticles;
    }
    if (name != "count" && name != "bounds") return Key::kNone;
    follows_ = name;
    return Key::kFollows;
}

Result<bool> AnswerInScene::end(bool other_clouds, SceneDraft& draft) {
    const auto wrong = [](std::string pointer, std::string message) {
        return Error{ErrorCode::kInvalidScene, std::move(pointer), std::move(message)};
    };
    if (!is_there_ && follows_.empty()) return false;
    if (!is_there_)
        return wrong("/" + follows_, "belongs to a list of \"particles\", and there is none");
    if (other_clouds)
        return wrong("/particles", "a scene has either \"particles\" or \"cubes\" or \"clouds\"");
    auto cloud = cloud_of(answer);
    if (!cloud) return cloud.error();
    answer = {};
    draft.clouds.push_back(*std::move(cloud));
    draft.top_level_cubes = false;
    return true;
}

std::size_t take_answered(TextCursor& cursor, ParticleAnswer& answer) {
    TextCursor c = cursor;
    while (answer.particles.size() < limits::kMaxParticles) {
        json_runs::skip_blanks(c);
        AnsweredParticle particle;
        if (!take_text(c, R"({"center":)") || !take_vector(c, particle.center) ||
            !take_text(c, R"(,"radius":)") || !json_runs::take_number(c, particle.radius) ||
            !take_text(c, R"(,"density":)") || !json_runs::take_number(c, particle.density) ||
            !take_text(c, R"(,"color":)") || !take_vector(c, particle.color) || !take_text(c, "}"))
            break;
        json_runs::skip_blanks(c);
        if (c.at == c.end || (*c.at != ',' && *c.at != ']')) break;
        answer.particles.push_back(particle);
        cursor = c;
        if (*c.at == ']') break;
        ++c.at;
        json_runs::skip_blanks(c);
        // A comma with nothing behind is for the parser to refuse.
        if (c.at == c.end || *c.at == ']') break;
        cursor = c;
    }
    return answer.particles.size();
}

}  // namespace awan
