// Awan as a library: from a scene to its particles, its plan and its picture, the same bytes as the program `awan` and
// the service make. What is declared here, and nothing else, is the library's interface. From version 1 on it stays as
// it is within one major version; before, within one minor version.
//
//     const auto scene = awan::library::read_scene(R"({"preset": "cumulus"})");
//     const std::string png = awan::library::render(scene).png();
//
// What goes wrong is thrown as an Error. Nothing here prints, ends the process or changes its signals, and nothing is
// kept from one call to the next but what the caller holds. All functions may be called on several threads at once;
// objects that are const may be shared among them.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#define AWAN_API __attribute__((visibility("default")))

namespace awan::library {

// What kind of thing went wrong.
enum class ErrorKind {
    kMalformed,  // the text is no JSON, or no layout at all
    kInvalidScene,  // it can be read, but no scene can be made of it, or an argument is not what it may be
    kUnsupported,   // a valid part of the contract that this version, or this machine, lacks
    kTooLarge,      // over a limit on size
    kNoRenderer,    // no EGL or no OpenGL 4.5 here, and the rung asks for it
    kOverDeadline,  // the time allowed ran out
    kOutOfMemory,   // the system has not enough memory or threads for it now
    kCancelled,     // Options::cancelled said so
    kInternal,      // a bug
};

class AWAN_API Error : public std::runtime_error {
  public:
    Error(ErrorKind kind, const std::string& place, const std::string& message);
    ErrorKind kind() const { return kind_; }
    // JSON pointer to the value that is wrong, "/cubes/3/size/1", or "line 14" of a text that is not JSON; "": of all
    // of it. what() begins with it.
    const std::string& place() const { return place_; }

  private:
    ErrorKind kind_;
    std::string place_;
};

// The library's version, "0.1.0".
AWAN_API const char* version();

// A valid scene. Cheap to copy.
class AWAN_API Scene {
  public:
    // Pixels of its picture.
    int width() const;
    int height() const;
    // The document as JSON, defaults left out; it reads back as the same scene.
    std::string json() const;
    // 32 hexadecimal digits: scenes of the same make the same cloud and the same picture.
    std::string digest() const;

    // The same with one value of the document changed: place is a JSON pointer, "/sun/elevation", value what --set of
    // the command line takes, "12". Errors: kInvalidScene.
    Scene with(std::string_view place, std::string_view value) const;

    struct Inside;
    explicit Scene(std::shared_ptr<const Inside> inside);
    const Inside& inside() const { return *inside_; }

  private:
    std::shared_ptr<const Inside> inside_;
};

// What a scene comes as. By default it is told from the bytes; a table whose first line holds one number is told from a
// layout only by name.
enum class SceneForm { kAny, kJson, kAwn, kAwa, kPly, kCsv };

// Of ready particles (PLY, CSV), scene units, > 0: the radius of all of them, in place of what the file says.
struct Reading {
    SceneForm form = SceneForm::kAny;
    std::optional<double> radius;
};

// Errors: kMalformed, kInvalidScene, kUnsupported, kTooLarge.
AWAN_API Scene read_scene(std::string_view bytes, const Reading& reading = {});

// How a call works.
struct Options {
    // 1..256; 0: as many as the machine has. The bytes are the same for all of them where the scene names a rung; else
    // more threads may afford another one.
    int threads = 0;
    // Seconds from the call, > 0; 0: as long as it takes. What would take longer is an Error, kOverDeadline.
    double deadline_s = 0;
    // True as soon as nobody wants the result any more. May be null.
    std::shared_ptr<const std::atomic<bool>> cancelled;
    // Called with the share that is done, 0..1, of what takes long (paths); on any thread, never on two at once. Must
    // not throw. May be empty.
    std::function<void(double)> progress;
};

// What would be simulated and why, and what every rung of accuracy would cost: the JSON that POST /v1/plan answers.
// Errors: kInvalidScene, kOverDeadline, kCancelled, kOutOfMemory.
AWAN_API std::string plan(const Scene& scene, const Options& options = {});

// A Gaussian blob of extinction: density * exp(-2 d^2 / radius^2) at distance d from its centre.
struct Particle {
    double x, y, z;          // scene units
    float radius;            // scene units, > 0
    float density;           // peak extinction, 1/unit, >= 0
    float red, green, blue;  // 0..1, each multiplies the albedo
};

class AWAN_API Particles {
  public:
    std::size_t size() const { return list_.size(); }
    std::span<const Particle> list() const { return list_; }
    // As files: a table, binary little-endian PLY, binary glTF. glb(): error where there are none.
    std::string csv() const;
    std::string ply() const;
    std::string glb() const;

    struct Inside;
    explicit Particles(std::shared_ptr<const Inside> inside);

  private:
    std::shared_ptr<const Inside> inside_;
    std::vector<Particle> list_;
};

// Errors as of plan().
AWAN_API Particles particles(const Scene& scene, const Options& options = {});

class AWAN_API Picture {
  public:
    int width() const;
    int height() const;
    // Linear radiance, Rec. 709, alpha premultiplied: red, green, blue, alpha of each pixel, row by row from the top
    // left. Valid as long as the picture.
    std::span<const float> pixels() const;
    // Which of the ladder's methods made it, "transport-24".
    std::string rung() const;
    // Its relative error, measured while it was made; NaN: it was not, or there is none to be had (a look).
    double error() const;
    // As files. bits: 8 or 16 a channel, after exposure and tone curve; 0: as the scene says. EXR has what pixels()
    // has, and the layers that the scene asks for.
    std::string png(int bits = 0) const;
    std::string exr() const;

    struct Inside;
    explicit Picture(std::shared_ptr<const Inside> inside);

  private:
    std::shared_ptr<const Inside> inside_;
};

// Of a scene with a sequence, the picture at the document's `time`. Splats are drawn by OpenGL, with a context of the
// call's own. Errors: as of plan(), and kNoRenderer.
AWAN_API Picture render(const Scene& scene, const Options& options = {});

}  // namespace awan::library
