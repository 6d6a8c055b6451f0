#pragma once
// Lets the names of an enumeration be said once, for the command line, for messages and for files.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace coseg {

template <class E>
struct EnumName {
    E value;
    std::string_view name;
};

/// An enumeration whose header gives `constexpr std::array<EnumName<E>, n> enum_names(E)`: each enumerator
/// with its name, in the order in which people are told of them. The argument only chooses the enumeration.
/// Old names that are still understood, but no longer written, stand in a second table of that form,
/// `enum_aliases(E)`.
template <class E>
concept NamedEnum = std::is_enum_v<E> && requires {
    enum_names(E{});
};

/// The name of an enumerator in the table; "" for a value that is none of the enumerators.
template <NamedEnum E>
constexpr std::string_view name_of(E value) {
    for (const EnumName<E>& row : enum_names(value)) {
        if (row.value == value) return row.name;
    }
    return "";
}

template <NamedEnum E>
std::string to_string(E value) {
    return std::string(name_of(value));
}

/// The enumerator of this name or alias; nothing where there is none.
template <NamedEnum E>
constexpr std::optional<E> named(std::string_view name) {
    for (const EnumName<E>& row : enum_names(E{})) {
        if (row.name == name) return row.value;
    }
    if constexpr (requires { enum_aliases(E{}); }) {
        for (const EnumName<E>& row : enum_aliases(E{})) {
            if (row.name == name) return row.value;
        }
    }
    return std::nullopt;
}

/// All names, in the order of the table, without aliases.
template <NamedEnum E>
std::vector<std::string> names_of() {
    std::vector<std::string> names;
    for (const EnumName<E>& row : enum_names(E{})) names.emplace_back(row.name);
    return names;
}

}  // namespace coseg
