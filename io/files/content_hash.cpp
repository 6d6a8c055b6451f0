#include "io/files/content_hash.hpp"

#include <xxhash.h>

#include <cstdio>
#include <new>

namespace coseg {

namespace {

ContentHash from_library(const XXH128_hash_t& hash) { return {hash.high64, hash.low64}; }

}  // namespace

std::string ContentHash::hex() const {
    char text[33];
    std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(high),
                  static_cast<unsigned long long>(low));
    return text;
}

ContentHash hash_bytes(std::string_view bytes) {
    return from_library(XXH3_128bits(bytes.data(), bytes.size()));
}

struct ContentHasher::State {
    XXH3_state_t* library = XXH3_createState();
    State() {
        if (library == nullptr) throw std::bad_alloc();
        XXH3_128bits_reset(library);
    }
    ~State() { XXH3_freeState(library); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
};

ContentHasher::ContentHasher() : state_(std::make_unique<State>()) {}
ContentHasher::~ContentHasher() = default;

void ContentHasher::add_bytes(const void* bytes, std::size_t count) {
    if (count > 0) XXH3_128bits_update(state_->library, bytes, count);
}

void ContentHasher::add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    add_bytes(text.data(), text.size());
}

ContentHash ContentHasher::result() const { return from_library(XXH3_128bits_digest(state_->library)); }

}  // namespace coseg
