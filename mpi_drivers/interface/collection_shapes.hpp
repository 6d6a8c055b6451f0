#pragma once
// Makes the meshes of a collection of the shapes that a caller of the interface gives.

#include <coseg/coseg.hpp>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "io/files/content_hash.hpp"
#include "io/mesh_files/mesh_list.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// The entries of a collection, sorted by name, which point to the caller's memory and to this object.
class CollectionShapes {
  public:
    /// Collective. Throws AgreedError: usage for no shape, a name that no file can have, or shapes that
    /// differ between ranks; input as expand_mesh_list does.
    CollectionShapes(const Comm& comm, std::span<const Shape> shapes);
    ~CollectionShapes() = default;
    CollectionShapes(const CollectionShapes&) = delete;
    CollectionShapes& operator=(const CollectionShapes&) = delete;

    [[nodiscard]] const std::vector<MeshEntry>& entries() const noexcept { return entries_; }
    /// The index among the caller's shapes of entry k.
    [[nodiscard]] std::size_t index_of(std::size_t k) const { return order_.at(k); }

  private:
    std::vector<PolygonView> views_;  ///< one a shape
    std::vector<MeshEntry> entries_;
    std::vector<std::size_t> order_;
};

/// Adds the names and the values of options.
void add_options(ContentHasher& hasher, const std::vector<Option>& options);

/// Throws AgreedError(usage) where the ranks have different hashes. `what`: "shapes". Collective.
void refuse_differences(const Comm& comm, const ContentHash& hash, const std::string& what);

}  // namespace coseg
