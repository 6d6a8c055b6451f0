#pragma once
// Reads the elements of an accessor one by one, wherever in the buffers they stand.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/gltf/gltf_asset.hpp"

namespace coseg {

/// Elements 0 .. count() - 1. The constructor has seen to it that all of them lie inside the bytes of the
/// file.
class GltfElements {
  public:
    /// Throws Error(input), a sentence that begins with "PATH: ", for an accessor without bytes of its own,
    /// or that leads out of them, or whose sparse part is not in ascending order. `asset` must outlive it.
    GltfElements(const GltfAsset& asset, int accessor);

    [[nodiscard]] std::size_t count() const { return accessor_->count; }
    [[nodiscard]] int components() const { return accessor_->components; }

    /// The bytes of an element as they stand in the file.
    [[nodiscard]] std::string_view bytes(std::size_t element) const;

    /// A component as a real number; a normalised whole number lies in -1 .. 1.
    [[nodiscard]] double real(std::size_t element, int component) const;

    /// The first component as a whole number, for indices.
    [[nodiscard]] std::uint32_t index(std::size_t element) const;

  private:
    void read_sparse(const GltfAsset& asset, const std::string& name);

    const GltfAccessor* accessor_;
    std::size_t size_;  ///< bytes of an element
    std::size_t stride_ = 0;
    std::string_view bytes_;               ///< from the first element on
    std::vector<std::uint32_t> replaced_;  ///< ascending
    std::string_view replacements_;
};

}  // namespace coseg
