#pragma once
// A 128-bit hash of bytes (XXH3). It names the files of a state folder, and it detects damage.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "src/records/fields.hpp"

namespace coseg {

/// It is not for secrets: it finds accidents, not attacks.
struct ContentHash {
    std::uint64_t high = 0;
    std::uint64_t low = 0;
    friend bool operator==(const ContentHash&, const ContentHash&) = default;
    friend auto operator<=>(const ContentHash&, const ContentHash&) = default;

    /// 32 hexadecimal digits, as `xxhsum -H2` prints them.
    [[nodiscard]] std::string hex() const;

    static constexpr auto fields() {
        return std::tuple(field("high", &ContentHash::high), field("low", &ContentHash::low));
    }
};

ContentHash hash_bytes(std::string_view bytes);

/// A hash of several values. The size of each text and array is hashed too, so that neighbours cannot be
/// confused.
class ContentHasher {
  public:
    ContentHasher();
    ~ContentHasher();
    ContentHasher(const ContentHasher&) = delete;
    ContentHasher& operator=(const ContentHasher&) = delete;

    /// Adds the bytes alone, without their number: pieces in a row give the hash of the whole.
    void add_bytes(const void* bytes, std::size_t count);
    void add(std::string_view text);
    template <class T>
    requires std::is_arithmetic_v<T>
    void add(T value) { add_bytes(&value, sizeof value); }
    template <class T>
    requires std::is_arithmetic_v<T>
    void add(std::span<const T> values) {
        add(static_cast<std::uint64_t>(values.size()));
        add_bytes(values.data(), values.size_bytes());
    }
    [[nodiscard]] ContentHash result() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace coseg
