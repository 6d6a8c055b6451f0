#pragma once
// Lets a record say its fields once. From this list it is packed for other ranks, written to files and
// hashed.

#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "src/base/enum_names.hpp"

namespace Eigen {  // NOLINT(readability-identifier-naming): the name is Eigen's
template <class Derived>
class PlainObjectBase;
}

namespace coseg {

/// How a field is kept in a file.
enum class Storage {
    plain,
    compressed,  ///< for large data with many equal values
};

/// One entry of a record's list.
template <class R, class T>
struct Field {
    const char* name;  ///< in files and reports; "" for a record whose own fields stand in its place
    T R::*member;
    Storage storage = Storage::plain;
};

template <class R, class T>
constexpr Field<R, T> field(const char* name, T R::*member, Storage storage = Storage::plain) {
    return {name, member, storage};
}

/// A record that is a field of another. Its fields are listed as if they were the other's own.
template <class R, class T>
constexpr Field<R, T> inlined(T R::*member) {
    return {"", member, Storage::plain};
}

/// A member that stays where it is. It is in the list so that the list is complete, but it is carried
/// nowhere.
template <class R, class T>
struct LocalMember {
    T R::*member;
};
template <class R, class T>
constexpr LocalMember<R, T> local(T R::*member) {
    return {member};
}

/// A plain struct with a list of its fields:
///
///     struct Point {
///         double x = 0.0;
///         double y = 0.0;
///         static constexpr auto fields() {
///             return std::tuple(field("x", &Point::x), field("y", &Point::y));
///         }
///     };
///
/// What a field may be: a number, a truth value, an enumeration, a text, a dense matrix of Eigen, another
/// record, and std::vector, std::array, std::optional and std::pair of these. Packing (packing.hpp), exchange
/// between ranks (src/parallel/record_exchange.hpp), HDF5 and hashes (io/files/record_file.hpp,
/// record_hash.hpp) and JSON (io/reports/record_json.hpp) follow from the list. A member that is not in it
/// does not compile.
template <class R>
concept Record = requires {
    std::remove_const_t<R>::fields();
};

namespace kinds {

template <class T>
inline constexpr bool is_vector = false;
template <class T, class A>
inline constexpr bool is_vector<std::vector<T, A>> = true;

template <class T>
inline constexpr bool is_array = false;
template <class T, std::size_t N>
inline constexpr bool is_array<std::array<T, N>> = true;

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

template <class T>
inline constexpr bool is_pair = false;
template <class A, class B>
inline constexpr bool is_pair<std::pair<A, B>> = true;

}  // namespace kinds

/// Numbers, truth values and enumerations.
template <class T>
concept Scalar = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Scalars that lie side by side in a std::vector; std::vector<bool> packs its own.
template <class T>
concept PlainScalar = Scalar<T> && !std::same_as<T, bool>;

/// A matrix or vector of Eigen that owns its entries. Its header is not needed to say so.
template <class T>
concept DenseMatrix = std::derived_from<T, Eigen::PlainObjectBase<T>>;

namespace kinds {

/// Does not compile where the list of R is shorter or longer than R. One case for each number of members: the
/// language has no other way to count them.
template <class R>
// NOLINTNEXTLINE(readability-function-size): a branch for each number of members
constexpr void refuse_forgotten_member(const R& record) {
    constexpr std::size_t listed = std::tuple_size_v<decltype(R::fields())>;
    static_assert(listed >= 1 && listed <= 20, "a record has 1 to 20 fields: nest records, or add a case");
    [[maybe_unused]] const auto& r = record;
    // clang-format off
    if constexpr (listed == 1) { [[maybe_unused]] const auto& [a] = r; }
    if constexpr (listed == 2) { [[maybe_unused]] const auto& [a, b] = r; }
    if constexpr (listed == 3) { [[maybe_unused]] const auto& [a, b, c] = r; }
    if constexpr (listed == 4) { [[maybe_unused]] const auto& [a, b, c, d] = r; }
    if constexpr (listed == 5) { [[maybe_unused]] const auto& [a, b, c, d, e] = r; }
    if constexpr (listed == 6) { [[maybe_unused]] const auto& [a, b, c, d, e, f] = r; }
    if constexpr (listed == 7) { [[maybe_unused]] const auto& [a, b, c, d, e, f, g] = r; }
    if constexpr (listed == 8) { [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h] = r; }
    if constexpr (listed == 9) { [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i] = r; }
    if constexpr (listed == 10) { [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j] = r; }
    if constexpr (listed == 11) { [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j, k] = r; }
    if constexpr (listed == 12) { [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j, k, l] = r; }
    if constexpr (listed == 13) { [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = r; }
    if constexpr (listed == 14) { [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = r; }
    if constexpr (listed == 15) { [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = r; }
    if constexpr (listed == 16) { [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = r; }
    if constexpr (listed == 17) { [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q] = r; }
    if constexpr (listed == 18) { [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, s] = r; }
    if constexpr (listed == 19) { [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, s, t] = r; }
    if constexpr (listed == 20) { [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, s, t, u] = r; }
    // clang-format on
}

}  // namespace kinds

namespace kinds {

template <class Entry>
inline constexpr bool is_local = false;
template <class R, class T>
inline constexpr bool is_local<LocalMember<R, T>> = true;

template <class R, class Entry, class Visit>
constexpr void visit_field(R& record, const Entry& entry, Visit& visit) {
    if constexpr (!is_local<Entry>) visit(entry, record.*(entry.member));
}

}  // namespace kinds

/// Calls visit(entry, value) for every field in the order of the list; `entry` is the Field. R may be const.
template <Record R, class Visit>
constexpr void for_each_field(R& record, Visit&& visit) {
    kinds::refuse_forgotten_member<std::remove_const_t<R>>(record);
    std::apply([&](const auto&... entry) { (kinds::visit_field(record, entry, visit), ...); },
               std::remove_const_t<R>::fields());
}

}  // namespace coseg
