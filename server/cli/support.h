// What the commands of the command line share.
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/gl/device.h"
#include "core/plan/plan.h"
#include "core/scene/scene.h"
#include "server/cli/cli.h"

namespace awan {

// One line that is overwritten, on a terminal only. Any thread may write to it.
class ProgressLine {
  public:
    ProgressLine();
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    // What is done now; how far it has come is unknown.
    void say(const std::string& what);
    // How much of the whole is done, 0..1.
    void done(double share);
    // Leaves the line empty, for what is printed next.
    void clear();

  private:
    void show();

    const bool shown_;
    std::mutex mutex_;
    std::string what_;
    // -1 where it is unknown.
    int percent_ = -1;
};

// Prints the message; the exit code of bad usage.
int bad_usage(const std::string& message);

// The code to exit with after the last step: fine, or what failed in reading or writing.
int end_with(const Status& failed);

// The format an output is written in: its extension, or --format, which must agree with it.
// For standard output: --format, or `otherwise`.
Result<std::string> output_format(const std::string& output, const std::string& format,
                                  const std::vector<std::string>& known,
                                  const std::string& otherwise);

// Whether output would go to a terminal, where bytes that are no text do harm.
bool binary_to_terminal(const std::string& output);

// Opens a device if there is none yet and the plan's rung needs one.
Status open_for(const Plan& plan, DeviceChoice choice, std::optional<Device>& device);

}  // namespace awan
