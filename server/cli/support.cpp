#include "server/cli/support.h"

#include <strings.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "server/service/problem.h"

namespace awan {

ProgressLine::ProgressLine() : shown_(isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
    clear();
}

void ProgressLine::clear() {
    if (shown_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::say(const std::string& what) {
    const std::lock_guard lock(mutex_);
    what_ = what;
    show();
}

void ProgressLine::done(double share) {
    const int percent = std::clamp(static_cast<int>(share * 100), 0, 100);
    const std::lock_guard lock(mutex_);
    if (percent == percent_) return;
    percent_ = percent;
    show();
}

void ProgressLine::show() {
    if (!shown_) return;
    const std::string far = percent_ < 0 ? " ..." : ", " + std::to_string(percent_) + "%";
    std::fprintf(stderr, "\r\033[Kawan: %s%s", what_.c_str(), far.c_str());
    std::fflush(stderr);
}

int bad_usage(const std::string& message) {
    std::fprintf(stderr, "awan: %s\n", message.c_str());
    return kExitUsage;
}

int end_with(const Status& failed) {
    return failed ? report_error("", *failed) : kExitFine;
}

Result<std::string> output_format(const std::string& output, const std::string& format,
                                  const std::vector<std::string>& known,
                                  const std::string& otherwise) {
    std::string all;
    for (const std::string& name : known) all += (all.empty() ? "." : ", .") + name;
    const auto unknown = [&](const std::string& what) {
        return Error{ErrorCode::kIo, "", what + "; this command writes " + all};
    };
    if (output == "-") return format.empty() ? otherwise : format;
    for (const std::string& name : known) {
        const std::string extension = "." + name;
        if (output.size() <= extension.size() ||
            strcasecmp(output.c_str() + output.size() - extension.size(), extension.c_str()) != 0)
            continue;
        if (!format.empty() && format != name)
            return unknown("-o " + output + " and --format " + format + " contradict each other");
        return name;
    }
    // Devices and pipes have no extension, so a format may be named.
    if (!format.empty() && output.rfind('.') == std::string::npos) return format;
    return unknown("-o " + output + ": unknown extension");
}

bool binary_to_terminal(const std::string& output) {
    return output == "-" && isatty(STDOUT_FILENO) == 1;
}

Status open_for(const Plan& plan, DeviceChoice choice, std::optional<Device>& device) {
    const Rung* const rung = plan.predicted.rung;
    if (device || rung == nullptr || !needs_renderer(rung->method)) return std::nullopt;
    auto opened = Device::open(choice);
    if (!opened) return opened.error();
    device.emplace(*std::move(opened));
    return std::nullopt;
}

int report_error(const std::string& subject, const Error& error) {
    std::string line = "awan: ";
    if (error.code != ErrorCode::kIo && !subject.empty()) line += subject + ": ";
    if (!error.pointer.empty()) line += error.pointer + ": ";
    std::fprintf(stderr, "%s%s\n", line.c_str(), error.message.c_str());
    return exit_code_of(error.code);
}

}  // namespace awan
