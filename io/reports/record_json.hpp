#pragma once
// Writes records as JSON: a record is an object with a member for each field.

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/reports/json_tree.hpp"
#include "src/records/fields.hpp"

namespace coseg {

/// Sets a record, or anything that a field may be. Vectors and pairs are arrays. An optional value that is
/// not there is null, or is left out if it is a field. An enumeration with names is a text. A matrix is an
/// array of its columns, a vector of Eigen an array of its entries.
template <class T>
void set_json(JsonPlace place, const T& value) {
    if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string>) {
        place.set(value);
    } else if constexpr (std::is_floating_point_v<T>) {
        place.set(static_cast<double>(value));
    } else if constexpr (NamedEnum<T>) {
        place.set(name_of(value));
    } else if constexpr (std::is_unsigned_v<T>) {
        place.set(static_cast<std::uint64_t>(value));
    } else if constexpr (Scalar<T>) {
        place.set(static_cast<std::int64_t>(value));
    } else if constexpr (kinds::is_vector<T> || kinds::is_array<T>) {
        place.set_array();
        for (const typename T::value_type& element : value) set_json(place.element(), element);
    } else if constexpr (kinds::is_optional<T>) {
        place.set_null();
        if (value) set_json(place, *value);
    } else if constexpr (kinds::is_pair<T>) {
        place.set_array();
        set_json(place.element(), value.first);
        set_json(place.element(), value.second);
    } else if constexpr (DenseMatrix<T>) {
        place.set_array();
        for (Eigen::Index column = 0; column < value.cols(); ++column) {
            const JsonPlace entries = T::ColsAtCompileTime == 1 ? place : place.element();
            if (T::ColsAtCompileTime != 1) entries.set_array();
            for (Eigen::Index row = 0; row < value.rows(); ++row)
                set_json(entries.element(), value(row, column));
        }
    } else {
        static_assert(Record<T>, "neither a record nor a kind of value that records are made of");
        place.set_object();
        set_json_members(place, value);
    }
}

/// Sets the fields of a record as members of an object that may have others.
template <Record R>
void set_json_members(JsonPlace object, const R& record) {
    for_each_field(record, [&](const auto& entry, const auto& member) {
        if constexpr (Record<std::remove_cvref_t<decltype(member)>>) {
            if (std::string_view(entry.name).empty()) return set_json_members(object, member);
        }
        if constexpr (kinds::is_optional<std::remove_cvref_t<decltype(member)>>) {
            if (!member) return;
        }
        set_json(object.member(entry.name), member);
    });
}

}  // namespace coseg
