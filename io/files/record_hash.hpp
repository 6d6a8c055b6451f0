#pragma once
// Adds records to a hash. Every field counts, so that a new one cannot be left out of a key.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/content_hash.hpp"
#include "src/records/fields.hpp"

namespace coseg {

/// Adds a record, or anything that a field may be. The size of each value is added too, so that neighbours
/// cannot be confused.
template <class T>
void add_value(ContentHasher& hasher, const T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
        hasher.add(value);
    } else if constexpr (std::is_enum_v<T>) {
        hasher.add(static_cast<std::underlying_type_t<T>>(value));
    } else if constexpr (std::is_same_v<T, std::string>) {
        hasher.add(std::string_view(value));
    } else if constexpr (kinds::is_vector<T> || kinds::is_array<T>) {
        using Element = typename T::value_type;
        if constexpr (PlainScalar<Element> && std::is_arithmetic_v<Element>) {
            hasher.add(std::span<const Element>(value));
        } else {
            hasher.add(static_cast<std::uint64_t>(value.size()));
            for (const Element& element : value) add_value(hasher, element);
        }
    } else if constexpr (kinds::is_optional<T>) {
        hasher.add(value.has_value());
        if (value) add_value(hasher, *value);
    } else if constexpr (kinds::is_pair<T>) {
        add_value(hasher, value.first);
        add_value(hasher, value.second);
    } else if constexpr (DenseMatrix<T>) {
        hasher.add(static_cast<std::int64_t>(value.rows()));
        hasher.add(static_cast<std::int64_t>(value.cols()));
        hasher.add_bytes(value.data(), static_cast<std::size_t>(value.size()) * sizeof(typename T::Scalar));
    } else {
        static_assert(Record<T>, "neither a record nor a kind of value that records are made of");
        for_each_field(value, [&](const auto&, const auto& member) { add_value(hasher, member); });
    }
}

}  // namespace coseg
