#pragma once
// Reads numbers out of binary data, and never beyond its end.

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

namespace coseg {

class ByteCursor {
  public:
    ByteCursor(std::string_view bytes, std::size_t offset, bool is_big_endian)
        : bytes_(bytes),
          offset_(offset),
          swaps_(is_big_endian != (std::endian::native == std::endian::big)) {}

    [[nodiscard]] std::size_t left() const { return bytes_.size() - offset_; }

    /// False, and nothing is read, if fewer bytes are left than T has.
    template <typename T>
    bool read(T& value) {
        if (left() < sizeof(T)) return false;
        char raw[sizeof(T)];
        for (std::size_t i = 0; i < sizeof(T); ++i) raw[swaps_ ? sizeof(T) - 1 - i : i] = bytes_[offset_ + i];
        std::memcpy(&value, raw, sizeof(T));
        offset_ += sizeof(T);
        return true;
    }

  private:
    std::string_view bytes_;
    std::size_t offset_;
    bool swaps_;
};

/// Appends a number's little-endian bytes.
template <typename T>
void append_little_endian(std::string& bytes, T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if constexpr (std::endian::native == std::endian::big) {
        for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(raw[i], raw[sizeof(T) - 1 - i]);
    }
    bytes.append(raw, sizeof(T));
}

}  // namespace coseg
