#pragma once
// The folder that keeps what runs have computed. This header says where its files are and where damaged ones
// go.

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

/// The layout of the folder:
/// - DIR/coseg-state marks the folder as ours.
/// - DIR/lock is the file of StateLock.
/// - DIR/meshes/AB/HASH.h5 holds the description of one mesh.
/// - DIR/solver/HASH/ holds the progress of the optimiser.
/// - DIR/cuts/HASH.h5 holds the outcome of a cut.
/// - DIR/damaged/ holds files that were set aside.
/// Nothing here communicates.
class StateFolder {
  public:
    /// Makes the folder, or what is missing of it. Throws Error(output) if DIR cannot be made or holds other
    /// things without our mark.
    static StateFolder make(const std::string& directory);
    /// Throws Error(input) if DIR is not a state folder.
    static StateFolder open(const std::string& directory);
    /// For ranks that are given the path of a folder which another rank has made.
    static StateFolder at(const std::string& absolute_path) { return StateFolder(absolute_path); }

    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    [[nodiscard]] std::string lock_file() const { return path_ + "/lock"; }
    /// The file of a mesh's description, in one of 256 subfolders by the first byte of the hash.
    [[nodiscard]] std::string mesh_file(const ContentHash& key) const;
    [[nodiscard]] std::string solver_folder(const ContentHash& key) const;
    [[nodiscard]] std::string cut_file(const ContentHash& key) const;

    /// Moves a damaged file to DIR/damaged/ and returns its new path; removes it if it cannot be moved.
    [[nodiscard]] std::string set_aside(const std::string& file) const;

    /// All HDF5 files of meshes/, solver/ and cuts/, by path.
    [[nodiscard]] std::vector<StateFile> files() const;
    /// The files of DIR/damaged/, and those that killed runs left under temporary names anywhere in DIR.
    [[nodiscard]] std::vector<StateFile> leftovers() const;

  private:
    explicit StateFolder(std::string path) : path_(std::move(path)) {}
    std::string path_;
};

/// Marks a file as used now, which StateFile::age_seconds counts from. It is no error if the file cannot be
/// marked.
void mark_as_used(const std::string& file) noexcept;

/// Makes the folders in which a file is to lie. Throws Error(output).
void make_parent_folders(const std::string& file);

}  // namespace coseg
