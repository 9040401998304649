// Floats that begin at a cache line, so that no vector of sixteen lies across two. resize() leaves new ones unset.
#pragma once

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace awan {

template <typename Value>
struct CacheLineAllocator {
    using value_type = Value;
    static constexpr std::align_val_t kLine{64};

    CacheLineAllocator() = default;
    template <typename Other>
    explicit CacheLineAllocator(const CacheLineAllocator<Other>& /*other*/) {}

    Value* allocate(std::size_t count) {
        return static_cast<Value*>(::operator new(count * sizeof(Value), kLine));
    }
    // A float that nothing is put into stays as it is: memory that is filled anyway is not zeroed before.
    template <typename Made>
    void construct(Made* at) {
        ::new (static_cast<void*>(at)) Made;
    }
    template <typename Made, typename From>
    void construct(Made* at, From&& from) {
        ::new (static_cast<void*>(at)) Made(std::forward<From>(from));
    }
    void deallocate(Value* at, std::size_t /*count*/) { ::operator delete(at, kLine); }
    friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

using AlignedFloats = std::vector<float, CacheLineAllocator<float>>;

}  // namespace awan
