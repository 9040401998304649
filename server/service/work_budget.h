// How much memory all requests together may use for their scenes. A large scene is welcome alone;
// many at once are told to come again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>

#include "core/scene/scene.h"
#include "server/limits.h"

namespace awan {

// A number of bytes that requests take from and give back to. Thread-safe.
class WorkBudget {
  public:
    explicit WorkBudget(std::size_t bytes) : bytes_(bytes) {}

    // Bytes that are given back when it is destroyed. Must not outlive the budget.
    class Lease {
      public:
        Lease() = default;
        Lease(Lease&& other) noexcept
            : budget_(std::exchange(other.budget_, nullptr)), bytes_(other.bytes_) {}
        Lease& operator=(Lease&& other) noexcept {
            std::swap(budget_, other.budget_);
            std::swap(bytes_, other.bytes_);
            return *this;
        }
        ~Lease() {
            if (budget_) budget_->give_back(bytes_);
        }
        explicit operator bool() const { return budget_ != nullptr; }

        // More for the same work. False, and nothing is taken, when so much is not left; what would make it more than
        // the whole budget is taken as the rest of it. Precondition: it holds some.
        bool grow(std::size_t bytes) {
            bytes = std::min(bytes, budget_->bytes_ - bytes_);
            if (!budget_->try_take(bytes)) return false;
            bytes_ += bytes;
            return true;
        }

      private:
        friend class WorkBudget;
        Lease(WorkBudget* budget, std::size_t bytes) : budget_(budget), bytes_(bytes) {}
        WorkBudget* budget_ = nullptr;
        std::size_t bytes_ = 0;
    };

    // False when so much is not left. What is more than the whole budget is taken as the whole
    // budget: then it runs alone.
    Lease take(std::size_t bytes) {
        bytes = std::min(bytes, bytes_);
        return try_take(bytes) ? Lease(this, bytes) : Lease{};
    }

    std::size_t bytes() const { return bytes_; }
    std::size_t taken() const {
        const std::lock_guard lock(mutex_);
        return taken_;
    }

  private:
    bool try_take(std::size_t bytes) {
        const std::lock_guard lock(mutex_);
        if (taken_ + bytes > bytes_) return false;
        taken_ += bytes;
        return true;
    }
    void give_back(std::size_t bytes) {
        const std::lock_guard lock(mutex_);
        taken_ -= bytes;
    }

    mutable std::mutex mutex_;
    const std::size_t bytes_;
    std::size_t taken_ = 0;
};

// An estimate of what a document takes while it is read, beside its own bytes. Short ones take none: there is one a
// lane.
inline std::size_t reading_bytes(std::size_t body_bytes) {
    return body_bytes <= limits::kFreeBodyBytes ? 0 : body_bytes * limits::kBytesPerBodyByte;
}

// An estimate of what a scene takes while it is worked on.
inline std::size_t work_bytes(const SceneDraft& scene, bool with_image) {
    const auto side = [](int pixels) { return static_cast<std::size_t>(std::max(pixels, 0)); };
    // Layers are marched as up to five more pictures.
    const std::size_t pictures = scene.image.layers == "none" ? 1 : 6;
    const std::size_t pixels =
        with_image ? pictures * side(scene.image.width) * side(scene.image.height) : 0;
    return static_cast<std::size_t>(particle_count(scene)) * limits::kBytesPerParticle +
           pixels * limits::kBytesPerPixel;
}

}  // namespace awan
