#pragma once
// Reads the elements of an accessor one by one, wherever in the buffers they stand.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/gltf/gltf_asset.hpp"

namespace coseg {

/// Whether an accessor has bytes, or zeros that a sparse part replaces.
bool has_elements(const GltfAccessor& accessor);

/// The most elements that a file with buffers of this size may have without bytes of their own, or draw by
/// drawing some of them many times over: 64 for each byte, and 3,000,000 in any file. More are no shape, but
/// would fill the memory.
std::size_t most_elements(const GltfAsset& asset);

/// Elements 0 .. count() - 1. The constructor has seen to it that all of them lie inside the bytes of the
/// file.
class GltfElements {
  public:
    /// Without a buffer view, all are zeros but those that the sparse part replaces. Throws Error(input), a
    /// sentence that begins with "PATH: ", for an accessor that has neither, leads out of its bytes, has more
    /// elements without bytes than most_elements, or a sparse part that is not in ascending order. `asset`
    /// must outlive it.
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
