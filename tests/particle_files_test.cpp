// CSV and PLY: what we write reads back exactly, what others write is read, and what is rejected.
#include "core/formats/particle_files.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>

#include "core/scene/limits.h"
#include "core/scene/validate.h"
#include "tests/patience.h"

namespace awan {
namespace {

ParticleSet some_particles(std::size_t count, bool colored) {
    ParticleSet set;
    std::uint32_t bits = 1;
    const auto next = [&] {
        bits = bits * 1664525u + 1013904223u;
        return static_cast<double>(bits) / 4294967296.0;
    };
    for (std::size_t i = 0; i < count; ++i) {
        set.center.emplace_back(std::exp(40 * next() - 20), -1e9 * next(), next() / 3);
        set.radius.push_back(static_cast<float>(std::exp(26 * next() - 13)));
        set.density.push_back(static_cast<float>(next()));
        if (colored) set.color.emplace_back(next(), next(), next());
    }
    return set;
}

std::string csv_of(const ParticleSet& set) {
    std::string out;
    append_csv_header(out);
    append_csv(set, 0, set.size(), out);
    return out;
}

std::string ply_of(const ParticleSet& set) {
    std::string out;
    append_ply_header(set, out);
    append_ply(set, 0, set.size(), out);
    return out;
}

void expect_same(const Result<SceneDraft>& draft, const ParticleSet& set) {
    ASSERT_TRUE(draft.ok()) << draft.error().pointer << ": " << draft.error().message;
    EXPECT_FALSE(draft->top_level_cubes);
    ASSERT_EQ(draft->clouds.size(), 1u);
    const Cloud& cloud = draft->clouds[0];
    EXPECT_EQ(cloud.model, CloudModel::kParticles);
    EXPECT_EQ(cloud.density, 1.0);  // the column holds extinction
    EXPECT_EQ(cloud.ready.positions, set.center);
    EXPECT_EQ(cloud.ready.radii, set.radius);
    EXPECT_EQ(cloud.ready.densities, set.density);
    EXPECT_EQ(cloud.ready.colors, set.color);
}

TEST(ParticleFiles, WhatIsWrittenReadsBackExactly) {
    for (const bool colored : {false, true})
        for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{5000}}) {
            const ParticleSet set = some_particles(count, colored);
            expect_same(read_particles_csv(csv_of(set)), set);
            expect_same(read_particles_ply(ply_of(set)), set);
        }
}

TEST(ParticleFiles, PiecesMakeTheSameFile) {
    const ParticleSet set = some_particles(100, true);
    std::string csv, ply;
    append_csv_header(csv);
    append_ply_header(set, ply);
    for (std::size_t i = 0; i < 100; i += 25) {
        append_csv(set, i, i + 25, csv);
        append_ply(set, i, i + 25, ply);
    }
    EXPECT_EQ(csv, csv_of(set));
    EXPECT_EQ(ply, ply_of(set));
}

TEST(ParticleFiles, HaveTheFormTheContractNames) {
    ParticleSet set;
    set.center = {{1, 2.5, -3}};
    set.radius = {0.1f};
    set.density = {0.55f};
    EXPECT_EQ(csv_of(set), "x,y,z,radius,density,r,g,b\n1,2.5,-3,0.1,0.55,1,1,1\n");
    const std::string ply = ply_of(set);
    const std::size_t header = ply.find("end_header\n") + 11;
    EXPECT_EQ(ply.size() - header, 44u);
    double y = 0;
    float radius = 0, blue = 0;
    std::memcpy(&y, ply.data() + header + 8, sizeof y);
    std::memcpy(&radius, ply.data() + header + 24, sizeof radius);
    std::memcpy(&blue, ply.data() + header + 40, sizeof blue);
    EXPECT_EQ(y, 2.5);
    EXPECT_EQ(radius, 0.1f);
    EXPECT_EQ(blue, 1.0f);
}

// A stranger's reader, from the format's definition alone.
TEST(ParticleFiles, PythonReadsThePly) {
    const ParticleSet set = some_particles(1000, true);
    const std::string path = testing::TempDir() + "awan_particles.ply";
    const std::string bytes = ply_of(set);
    std::ofstream(path, std::ios::binary) << bytes;
    const std::string command =
        std::string("python3 -c \"") +
        "import struct,sys\n"
        "head,body=open('" +
        path +
        "','rb').read().split(b'end_header\\n',1)\n"
        "lines=head.decode('ascii').splitlines()\n"
        "assert lines[:2]==['ply','format binary_little_endian 1.0'],lines\n"
        "n=[int(l.split()[2]) for l in lines if l.startswith('element vertex')][0]\n"
        "kinds=''.join({'double':'d','float':'f'}[l.split()[1]] for l in lines if "
        "l.startswith('property'))\n"
        "rows=list(struct.iter_unpack('<'+kinds,body))\n"
        "assert len(rows)==n\n"
        "print(repr(sum(r[1] for r in rows)),repr(sum(r[3] for r in rows)))\n\"";
    FILE* const pipe = popen(command.c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    double y = 0, radius = 0;
    EXPECT_EQ(std::fscanf(pipe, "%lf %lf", &y, &radius), 2);
    EXPECT_EQ(pclose(pipe), 0);
    double want_y = 0, want_radius = 0;
    for (std::size_t i = 0; i < set.size(); ++i) {
        want_y += set.center[i].y;
        want_radius += double{set.radius[i]};
    }
    EXPECT_EQ(y, want_y);
    EXPECT_EQ(radius, want_radius);
    std::remove(path.c_str());
}

TEST(ParticleFiles, NumbersAreTheShortestThatReadBack) {
    const auto text = [](auto value) {
        std::string out;
        append_number(value, out);
        return out;
    };
    EXPECT_EQ(text(0.1), "0.1");
    EXPECT_EQ(text(0.1f), "0.1");
    EXPECT_EQ(text(200.0), "200");
    EXPECT_EQ(text(1.0 / 3), "0.3333333333333333");
    EXPECT_EQ(text(std::numeric_limits<double>::max()), "1.7976931348623157e+308");
    EXPECT_EQ(text(-std::numeric_limits<double>::denorm_min()), "-5e-324");
}

// --- CSV of others

TEST(ParticleCsv, FindsColumnsByNameInAnyOrderAndSkipsTheRest) {
    const Result<SceneDraft> draft = read_particles_csv(
        "\xEF\xBB\xBF\"id\",radius, z ,y,x,vx\r\na1, 0.5, 3, 2, 1, fast\r\n\r\nb,1,6,5,4,\r\n");
    ASSERT_TRUE(draft.ok()) << draft.error().message;
    const Cloud& cloud = draft->clouds[0];
    EXPECT_EQ(cloud.ready.positions, (std::vector<glm::dvec3>{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(cloud.ready.radii, (std::vector<float>{0.5f, 1}));
    EXPECT_TRUE(cloud.ready.densities.empty());
    EXPECT_FALSE(cloud.density);  // no column: the scene's default
    EXPECT_TRUE(cloud.ready.colors.empty());
    EXPECT_TRUE(validate(*draft).ok());
}

TEST(ParticleCsv, TakesColoursByEitherName) {
    for (const char* const names : {"red,green,blue", "r,g,b", "r,green,b"}) {
        const Result<SceneDraft> draft =
            read_particles_csv(std::string("x,y,z,radius,") + names + "\n1,2,3,4,0.25,0.5,0.75\n");
        ASSERT_TRUE(draft.ok()) << names;
        EXPECT_EQ(draft->clouds[0].ready.colors, (std::vector<glm::vec3>{{0.25f, 0.5f, 0.75f}}));
    }
}

void expect_malformed(const Result<SceneDraft>& draft, const std::string& pointer,
                      std::initializer_list<const char*> words) {
    ASSERT_FALSE(draft.ok());
    EXPECT_EQ(draft.error().code, ErrorCode::kMalformed);
    EXPECT_EQ(draft.error().pointer, pointer) << draft.error().message;
    for (const char* const word : words)
        EXPECT_NE(draft.error().message.find(word), std::string::npos)
            << '"' << draft.error().message << "\" lacks " << word;
    EXPECT_LT(draft.error().message.size(), 200u);
}

TEST(ParticleCsv, RejectsATableWithoutTheColumnsOfAParticle) {
    expect_malformed(read_particles_csv(""), "line 1", {"x"});
    expect_malformed(read_particles_csv("x,y,z\n1,2,3\n"), "line 1", {"no radius"});
    expect_malformed(read_particles_csv("1,2,3,4\n"), "line 1", {"no x"});
    expect_malformed(read_particles_csv("x,y,z,radius,r,g\n"), "line 1", {"colour"});
}

TEST(ParticleCsv, RejectsAColumnThatStandsTwice) {
    expect_malformed(read_particles_csv("x,y,z,radius,x\n"), "line 1", {"x", "twice"});
    expect_malformed(read_particles_csv("x,y,z,radius,red,g,b,red\n"), "line 1", {"red", "twice"});
}

TEST(ParticleCsv, RejectsLinesWithMoreOrFewerCells) {
    expect_malformed(read_particles_csv("x,y,z,radius\n1,2,3,4\n1,2,3\n"), "line 3", {"4", "3"});
    expect_malformed(read_particles_csv("x,y,z,radius\n1,2,3,4,5\n"), "line 2", {"4", "5"});
}

TEST(ParticleCsv, RejectsCellsThatAreNotFiniteNumbers) {
    for (const char* const bad :
         {"", "nan", "inf", "1e999", "one", "0x1", "1;2", "1e", "--1", "+-1"})
        expect_malformed(read_particles_csv(std::string("x,y,z,radius\n1,2,") + bad + ",4\n"),
                         "line 2, column 3", {"z", "finite"});
}

TEST(ParticleCsv, RejectsAMillionColumns) {
    expect_malformed(read_particles_csv(std::string(1'000'000, ',')), "line 1", {"256"});
}

TEST(ParticleCsv, RejectsMoreParticlesThanASceneMayHave) {
    std::string text = "x,y,z,radius\n";
    for (std::uint64_t i = 0; i <= limits::kMaxParticles; ++i) text += "0,0,0,1\n";
    const Result<SceneDraft> draft = read_particles_csv(text);
    ASSERT_FALSE(draft.ok());
    EXPECT_EQ(draft.error().code, ErrorCode::kTooLarge);
    EXPECT_EQ(draft.error().pointer, "line " + std::to_string(limits::kMaxParticles + 2));
}

// --- PLY of others

constexpr const char* kAsciiHead =
    "ply\nformat ascii 1.0\ncomment made by a DCC\nelement vertex 2\nproperty float x\n"
    "property float y\nproperty float z\nproperty float nx\nproperty float radius\n";

TEST(ParticlePly, ReadsAsciiWithColoursOfBytesAndAMeshBehind) {
    const Result<SceneDraft> draft = read_particles_ply(
        std::string(kAsciiHead) +
        "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n"
        "1 2 3 0 0.5 255 0 51\n4 5 6 0 1 255 255 255\n3 0 1 1\n");
    ASSERT_TRUE(draft.ok()) << draft.error().message;
    const ReadyParticles& ready = draft->clouds[0].ready;
    EXPECT_EQ(ready.positions, (std::vector<glm::dvec3>{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(ready.radii, (std::vector<float>{0.5f, 1}));
    EXPECT_EQ(ready.colors, (std::vector<glm::vec3>{{1, 0, 0.2f}, {1, 1, 1}}));
    EXPECT_FALSE(draft->clouds[0].density);
}

template <typename T>
void put(std::string& out, T value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    out.append(bytes, sizeof value);
}

TEST(ParticlePly, ReadsEveryScalarType) {
    std::string bytes =
        "ply\r\nformat binary_little_endian 1.0\r\nelement vertex 1\r\nproperty int8 x\r\n"
        "property short y\r\nproperty int z\r\nproperty double radius\r\nproperty uint id\r\n"
        "property ushort other\r\nproperty float density\r\nend_header\r\n";
    put<std::int8_t>(bytes, -7);
    put<std::int16_t>(bytes, -300);
    put<std::int32_t>(bytes, 70000);
    put(bytes, 0.25);
    put<std::uint32_t>(bytes, 1);
    put<std::uint16_t>(bytes, 2);
    put(bytes, 0.125f);
    const Result<SceneDraft> draft = read_particles_ply(bytes);
    ASSERT_TRUE(draft.ok()) << draft.error().message;
    EXPECT_EQ(draft->clouds[0].ready.positions[0], glm::dvec3(-7, -300, 70000));
    EXPECT_EQ(draft->clouds[0].ready.radii[0], 0.25f);
    EXPECT_EQ(draft->clouds[0].ready.densities[0], 0.125f);
    EXPECT_EQ(draft->clouds[0].density, 1.0);
}

// White is the largest value of the type, whichever it is.
TEST(ParticlePly, ColoursSpanTheirTypes) {
    const auto red_of = [](const std::string& type, const std::string& value) {
        const Result<SceneDraft> draft = read_particles_ply(
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
            "property float z\nproperty float radius\nproperty float density\nproperty " +
            type + " red\nproperty " + type + " green\nproperty " + type +
            " blue\nend_header\n0 0 0 1 1 " + value + " 0 0\n");
        EXPECT_TRUE(draft.ok()) << draft.error().message;
        return draft->clouds[0].ready.colors[0].r;
    };
    EXPECT_EQ(red_of("char", "127"), 1.0F);
    EXPECT_EQ(red_of("uchar", "255"), 1.0F);
    EXPECT_EQ(red_of("short", "32767"), 1.0F);
    EXPECT_EQ(red_of("ushort", "65535"), 1.0F);
    EXPECT_EQ(red_of("int", "2147483647"), 1.0F);
    EXPECT_EQ(red_of("uint", "4294967295"), 1.0F);
    EXPECT_EQ(red_of("float", "1"), 1.0F);
    EXPECT_EQ(red_of("double", "0.5"), 0.5F);
}

TEST(ParticlePly, NaNIsForValidateToReject) {
    ParticleSet set = some_particles(3, false);
    set.center[1].y = std::nan("");
    const Result<SceneDraft> draft = read_particles_ply(ply_of(set));
    ASSERT_TRUE(draft.ok());
    const Result<Scene> scene = validate(*draft);
    ASSERT_FALSE(scene.ok());
    EXPECT_EQ(scene.error().pointer, "/clouds/0/positions/1/1");
}

TEST(ParticlePly, RejectsHeadersThatAreNot) {
    const std::string head = kAsciiHead;
    expect_malformed(read_particles_ply(""), "", {"ply"});
    expect_malformed(read_particles_ply("x,y,z\n"), "", {"ply"});
    expect_malformed(read_particles_ply(head), "", {"end_header"});
    expect_malformed(read_particles_ply("ply\nend_header\n"), "", {"format"});
    expect_malformed(read_particles_ply("ply\nformat ascii 1.0\nend_header\n"), "", {"vertex"});
    expect_malformed(read_particles_ply("ply\nformat binary_middle_endian 1.0\n"), "line 2",
                     {"binary_little_endian"});
    expect_malformed(read_particles_ply("ply\nformat ascii 2.0\n"), "line 2", {"1.0"});
    expect_malformed(read_particles_ply("ply\nnonsense\n"), "line 2", {"nonsense"});
    expect_malformed(read_particles_ply("ply\nformat ascii 1.0\nelement face 1\nend_header\n"), "",
                     {"vertex"});
    expect_malformed(read_particles_ply("ply\nformat ascii 1.0\nelement vertex -1\n"), "line 3",
                     {"integer"});
    expect_malformed(read_particles_ply("ply\nproperty float x\n"), "line 2", {"element"});
    expect_malformed(read_particles_ply(head + "property real q\nend_header\n"), "line 10",
                     {"real"});
    expect_malformed(read_particles_ply(head + "property float x\nend_header\n"), "line 4",
                     {"twice"});
    std::string comments = "ply\n";
    for (int i = 0; i < 100'000; ++i) comments += "comment\n";
    expect_malformed(read_particles_ply(comments), "", {"end_header"});
}

TEST(ParticlePly, RejectsAsciiThatDoesNotMatchItsHeader) {
    const std::string head = std::string(kAsciiHead) + "end_header\n";
    EXPECT_TRUE(read_particles_ply(head + "1 2 3 0 1\n4 5 6 0 1\n\n").ok());
    expect_malformed(read_particles_ply(head + "1 2 3 0 1\n"), "", {"2", "1"});
    expect_malformed(read_particles_ply(head + "1 2 3 0\n4 5 6 0 1\n"), "line 11", {"5"});
    expect_malformed(read_particles_ply(head + "1 2 3 0 1 9\n4 5 6 0 1\n"), "line 11", {"more"});
    expect_malformed(read_particles_ply(head + "1 2 nan 0 1\n4 5 6 0 1\n"), "line 11", {"finite"});
    expect_malformed(read_particles_ply(head + "1 2 3 0 1\n4 5 6 0 1\n7 8 9 0 1\n"), "line 13",
                     {"after the last"});
}

TEST(ParticlePly, RejectsBinaryThatDoesNotMatchItsHeader) {
    const std::string good = ply_of(some_particles(3, false));
    expect_malformed(read_particles_ply(good.substr(0, good.size() - 1)), "", {"3", "2"});
    expect_malformed(read_particles_ply(good + "x"), "", {"1 bytes"});
}

TEST(ParticlePly, AHeaderThatClaimsBillionsCostsNothing) {
    const std::string head =
        "ply\nformat binary_little_endian 1.0\nelement vertex 4000000\nproperty float x\n"
        "property float y\nproperty float z\nproperty float radius\nend_header\n";
    const auto start = std::chrono::steady_clock::now();
    expect_malformed(read_particles_ply(head + "0123456789abcdef"), "", {"4000000", "1"});
    EXPECT_LT(std::chrono::steady_clock::now() - start, test::patience(1));
    std::string more = head;
    more.replace(more.find("4000000"), 7, "18446744073709551615");
    const Result<SceneDraft> draft = read_particles_ply(more);
    ASSERT_FALSE(draft.ok());
    EXPECT_EQ(draft.error().code, ErrorCode::kTooLarge);
}

}  // namespace
}  // namespace awan
