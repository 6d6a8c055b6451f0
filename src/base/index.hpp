#pragma once
// Makes indices of containers out of signed numbers of things.

#include <concepts>
#include <cstddef>
#include <type_traits>

namespace coseg {

/// The index of item `i`, which is not negative, in a container of the C++ library: values[at(i)]. Numbers of
/// faces, patches and meshes are signed here, so that their differences are safe, and an enumerator may
/// number the rows of a table.
template <class I>
requires std::integral<I> || std::is_enum_v<I>
constexpr std::size_t at(I i) noexcept { return static_cast<std::size_t>(i); }

}  // namespace coseg
