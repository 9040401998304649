// File descriptors that close themselves, and writing to them.
#pragma once

#include <string_view>
#include <utility>

namespace awan {

class Descriptor {
  public:
    explicit Descriptor(int fd = -1) : fd_(fd) {}
    Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(fd_, other.fd_);
        return *this;
    }
    ~Descriptor() { close(); }
    int get() const { return fd_; }
    // False, with errno: what a disk or its server was too late to say at write().
    bool close();

  private:
    int fd_;
};

// False, with errno: not all of them could be written.
bool write_all(int fd, std::string_view bytes);

}  // namespace awan
