#pragma once
// Packs records as bytes for ranks of the same program, and unpacks them.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "src/records/fields.hpp"

namespace coseg {

/// Appends values to bytes. Lengths are counted in 64 bits.
class Packer {
  public:
    template <class T>
    void add(const T& value) {
        if constexpr (Scalar<T>) {
            append(&value, sizeof value);
        } else if constexpr (std::is_same_v<T, std::string>) {
            add_length(value.size());
            append(value.data(), value.size());
        } else if constexpr (kinds::is_vector<T>) {
            add_length(value.size());
            add_elements(value);
        } else if constexpr (kinds::is_array<T>) {
            for (const auto& element : value) add(element);
        } else if constexpr (kinds::is_optional<T>) {
            add(value.has_value());
            if (value) add(*value);
        } else if constexpr (kinds::is_pair<T>) {
            add(value.first);
            add(value.second);
        } else if constexpr (DenseMatrix<T>) {
            add_length(static_cast<std::size_t>(value.rows()));
            add_length(static_cast<std::size_t>(value.cols()));
            append(value.data(), static_cast<std::size_t>(value.size()) * sizeof(typename T::Scalar));
        } else {
            static_assert(Record<T>, "neither a record nor a kind of value that records are made of");
            for_each_field(value, [&](const auto&, const auto& member) { add(member); });
        }
    }

    [[nodiscard]] std::vector<std::byte> take() && { return std::move(bytes_); }

  private:
    template <class T>
    void add_elements(const std::vector<T>& values) {
        if constexpr (PlainScalar<T>) {
            append(values.data(), values.size() * sizeof(T));
        } else {
            for (const T& value : values) add(value);
        }
    }
    void add_length(std::size_t length) { add(static_cast<std::uint64_t>(length)); }
    void append(const void* data, std::size_t size);
    std::vector<std::byte> bytes_;
};

/// Takes values from bytes in the order in which they were added. Throws Error(internal) where there are too
/// few bytes.
class Unpacker {
  public:
    explicit Unpacker(std::span<const std::byte> bytes) : rest_(bytes) {}

    [[nodiscard]] bool is_at_end() const noexcept { return rest_.empty(); }

    template <class T>
    void take(T& value) {
        if constexpr (Scalar<T>) {
            copy_to(&value, sizeof value);
        } else if constexpr (std::is_same_v<T, std::string>) {
            value.resize(take_length(1));
            copy_to(value.data(), value.size());
        } else if constexpr (kinds::is_vector<T>) {
            take_elements(value);
        } else if constexpr (kinds::is_array<T>) {
            for (auto& element : value) take(element);
        } else if constexpr (kinds::is_optional<T>) {
            if (taken<bool>()) {
                take(value.emplace());
            } else {
                value.reset();
            }
        } else if constexpr (kinds::is_pair<T>) {
            take(value.first);
            take(value.second);
        } else if constexpr (DenseMatrix<T>) {
            const auto rows = static_cast<std::ptrdiff_t>(taken<std::uint64_t>());
            const auto columns = static_cast<std::ptrdiff_t>(taken<std::uint64_t>());
            value.resize(rows, columns);
            copy_to(value.data(), static_cast<std::size_t>(value.size()) * sizeof(typename T::Scalar));
        } else {
            static_assert(Record<T>, "neither a record nor a kind of value that records are made of");
            for_each_field(value, [&](const auto&, auto& member) { take(member); });
        }
    }

    template <class T>
    [[nodiscard]] T taken() {
        T value{};
        take(value);
        return value;
    }

  private:
    template <class T>
    void take_elements(std::vector<T>& values) {
        if constexpr (PlainScalar<T>) {
            values.resize(take_length(sizeof(T)));
            copy_to(values.data(), values.size() * sizeof(T));
        } else {
            const std::size_t length = take_length(1);
            values.clear();
            values.reserve(length);
            for (std::size_t k = 0; k < length; ++k) values.push_back(taken<T>());
        }
    }
    /// Takes the length of a list whose elements have at least `element_bytes` bytes. They must be there.
    std::size_t take_length(std::size_t element_bytes) {
        const auto length = taken<std::uint64_t>();
        if (length > rest_.size() / element_bytes) refuse();
        return static_cast<std::size_t>(length);
    }
    void copy_to(void* data, std::size_t size);
    [[noreturn]] static void refuse();
    std::span<const std::byte> rest_;
};

template <class T>
std::vector<std::byte> packed(const T& value) {
    Packer packer;
    packer.add(value);
    return std::move(packer).take();
}

template <class T>
T unpacked(std::span<const std::byte> bytes) {
    return Unpacker(bytes).taken<T>();
}

}  // namespace coseg
