// Memory that runs out when a test says so: the Nth allocation of the process from now on fails, or that and all after
// it. For one test program (it replaces malloc there, or under sanitizers, which have one of their own, operator new).
#pragma once

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace awan::test {

class FailingMemory {
  public:
    enum class Which { kOne, kAllFrom };

    // From now on, the nth (from 1) allocation fails.
    static void arm(long n, Which which) {
        all_from_ = which == Which::kAllFrom;
        failed_ = 0;
        left_ = n;
        armed_ = true;
    }
    // Returns how many failed.
    static long disarm() {
        armed_ = false;
        return failed_;
    }
    // Allocations that are not given back yet.
    static long live() { return live_; }
    // Counts only.
    static void count() { arm(kNever, Which::kOne); }
    static long counted() {
        disarm();
        return kNever - left_;
    }

    // For the replaced functions.
    static bool fails() {
        if (!armed_.load(std::memory_order_relaxed)) return false;
        const long left = --left_;
        const bool now = left == 0 || (left < 0 && all_from_);
        if (now) ++failed_;
        return now;
    }
    static void made(const void* p) { live_ += p != nullptr; }
    static void gone(const void* p) { live_ -= p != nullptr; }

  private:
    static constexpr long kNever = 1L << 60;
    static inline std::atomic<bool> armed_{false}, all_from_{false};
    static inline std::atomic<long> left_{0}, failed_{0}, live_{0};
};

}  // namespace awan::test

#ifndef AWAN_SANITIZED

extern "C" {
// glibc's own, below the names that are replaced.
void* __libc_malloc(std::size_t);                 // NOLINT(bugprone-reserved-identifier)
void* __libc_calloc(std::size_t, std::size_t);    // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void*, std::size_t);         // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t, std::size_t);  // NOLINT(bugprone-reserved-identifier)
void __libc_free(void*);                          // NOLINT(bugprone-reserved-identifier)

inline void* awan_given(void* p) {
    if (p == nullptr) errno = ENOMEM;
    awan::test::FailingMemory::made(p);
    return p;
}
void* malloc(std::size_t n) {
    return awan_given(awan::test::FailingMemory::fails() ? nullptr : __libc_malloc(n));
}
void* calloc(std::size_t n, std::size_t size) {
    return awan_given(awan::test::FailingMemory::fails() ? nullptr : __libc_calloc(n, size));
}
void* realloc(void* p, std::size_t n) {
    if (awan::test::FailingMemory::fails()) {
        errno = ENOMEM;
        return nullptr;
    }
    void* const moved = __libc_realloc(p, n);
    if (p == nullptr) awan::test::FailingMemory::made(moved);
    if (p != nullptr && n == 0) awan::test::FailingMemory::gone(p);
    return moved;
}
void* memalign(std::size_t alignment, std::size_t n) {
    return awan_given(awan::test::FailingMemory::fails() ? nullptr : __libc_memalign(alignment, n));
}
void* aligned_alloc(std::size_t alignment, std::size_t n) {
    return memalign(alignment, n);
}
int posix_memalign(void** p, std::size_t alignment, std::size_t n) {
    void* const made = memalign(alignment, n);
    if (made == nullptr) return ENOMEM;
    *p = made;
    return 0;
}
void free(void* p) {
    awan::test::FailingMemory::gone(p);
    __libc_free(p);
}
}

#else

// NOLINTBEGIN(misc-definitions-in-headers)
void* operator new(std::size_t n) {
    void* const p = awan::test::FailingMemory::fails() ? nullptr : std::malloc(n);
    awan::test::FailingMemory::made(p);
    if (p == nullptr) throw std::bad_alloc();
    return p;
}
// libstdc++'s own would call the one above; a sanitizer's has memory of its own.
void* operator new(std::size_t n, const std::nothrow_t&) noexcept {
    void* const p = awan::test::FailingMemory::fails() ? nullptr : std::malloc(n);
    awan::test::FailingMemory::made(p);
    return p;
}
void operator delete(void* p) noexcept {
    awan::test::FailingMemory::gone(p);
    std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
    operator delete(p);
}
void operator delete(void* p, const std::nothrow_t&) noexcept {
    operator delete(p);
}
// NOLINTEND(misc-definitions-in-headers)

#endif
