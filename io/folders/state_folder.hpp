#pragma once
// The folder that keeps what runs have computed: where its files are, and what becomes of damaged ones.

#include <cstdint>
#include <string>
#include <vector>

#include "io/files/content_hash.hpp"

namespace coseg {

/// One file of a state folder.
struct StateFile {
    std::string path;
    std::uintmax_t bytes = 0;
    std::int64_t age_seconds = 0;  ///< since it was last written or used, never negative
};

/// DIR/coseg-state marks the folder as ours; DIR/lock is that of StateLock; DIR/meshes/AB/HASH.h5 holds one mesh's
/// description; DIR/solver/HASH/ the optimiser's progress; DIR/cuts/HASH.h5 a cut's outcome; DIR/damaged/ what was set
/// aside. Nothing here communicates.
class StateFolder {
  public:
    /// Makes what is missing. Throws Error(output) if DIR cannot be made or holds other things without our mark.
    static StateFolder make(const std::string& directory);
    /// Throws Error(input) if DIR is not a state folder.
    static StateFolder open(const std::string& directory);
    /// For ranks that are told of a folder which another rank has made.
    static StateFolder at(const std::string& absolute_path) { return StateFolder(absolute_path); }

    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    [[nodiscard]] std::string lock_file() const { return path_ + "/lock"; }
    /// 256 subfolders by the hash's first byte.
    [[nodiscard]] std::string mesh_file(const ContentHash& key) const;
    [[nodiscard]] std::string solver_folder(const ContentHash& key) const;
    [[nodiscard]] std::string cut_file(const ContentHash& key) const;

    /// Moves a damaged file to DIR/damaged/ and returns its new path; removes it if it cannot be moved.
    [[nodiscard]] std::string set_aside(const std::string& file) const;

    /// All HDF5 files of meshes/, solver/ and cuts/, by path.
    [[nodiscard]] std::vector<StateFile> files() const;
    /// Those of DIR/damaged/, and what killed runs left under temporary names anywhere in DIR.
    [[nodiscard]] std::vector<StateFile> leftovers() const;

  private:
    explicit StateFolder(std::string path) : path_(std::move(path)) {}
    std::string path_;
};

/// Marks a file as used now, for StateFile::age_seconds; no error if it cannot be marked.
void mark_as_used(const std::string& file) noexcept;

/// Makes the folders on the way to a file. Throws Error(output).
void make_parent_folders(const std::string& file);

}  // namespace coseg
