#pragma once
// The folder of results, which is there whole or not at all.

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

namespace coseg {

/// In a folder of results: locked while `coseg edit` works on the run.
inline constexpr const char* session_lock_name = ".corrections.lock";

/// A run's results are written into a folder beside the wanted one, DIR.partial-HOST-PID, which takes the
/// name DIR in commit(); if DIR exists, into DIR/.partial-HOST-PID, whose content commit() moves up. Without
/// commit the partial folder is removed, and nothing is left behind; what a process left that was killed is
/// removed by the next one on its machine that writes to DIR.
///
/// One rank creates and commits; the others write below the path that it hands them (staging()), all into a
/// file system that every rank sees.
///
///     OutputDirectory output("results", force);          // rank 0
///     write_labels(output.staging() + "/labels/cup.seg", labels);
///     output.commit();                                   // rank 0, after all ranks have written
class OutputDirectory {
  public:
    /// Creates the partial folder with labels/, patches/ and ply/ in it, and missing parents of DIR.
    /// Throws Error(output) if DIR is a file or a link to nothing, is a folder with anything in it (unless
    /// force; partial folders of killed runs do not count), if the partial folder cannot be created, or if
    /// something in DIR stands in the way of what commit() does: a folder where a file goes, a file where a
    /// folder goes, a folder of results that cannot be written to.
    OutputDirectory(const std::string& directory, bool force);
    ~OutputDirectory();
    OutputDirectory(const OutputDirectory&) = delete;
    OutputDirectory& operator=(const OutputDirectory&) = delete;

    /// Where to write until commit(): an absolute path without a slash at its end.
    [[nodiscard]] const std::string& staging() const { return staging_; }

    /// DIR as an absolute path.
    [[nodiscard]] const std::string& path() const { return path_; }

    /// Sees to it that results of meshes of these names can be written: makes and removes files with the
    /// longest name, and with every name that is not ASCII, and asks for the free space. `input_bytes` is the
    /// size of all mesh files. Throws Error(output), a sentence naming the mesh, so that a run fails before
    /// its work and not after it.
    void try_names(const std::vector<std::string>& names, std::uintmax_t input_bytes) const;

    /// Gives the results their name. In a folder that is not empty (force), files of the same name are
    /// replaced; corrections.json gets another name where its content differs. Files of an earlier run that
    /// this run did not write are removed: labels and PLY files (labels/*.seg, patches/*.seg, ply/*.ply),
    /// pictures (contact_sheet*.png, sheets/*.png) and the other files that not every run writes (model.h5,
    /// names.txt, features.h5, ...). Everything else stays. Throws Error(output); without force an existing
    /// DIR is then untouched.
    void commit();

    /// Removes the partial folder unless it has been committed. May be called from another thread.
    void abandon() noexcept;

  private:
    void refuse_what_is_there() const;
    void refuse_what_is_in_the_way() const;
    void create();
    void move_into_existing() const;
    void remove_partial() noexcept;

    std::string path_;
    std::string staging_;
    bool force_;
    std::mutex mutex_;
    bool is_committed_ = false;
    std::vector<std::filesystem::path> created_parents_;  ///< outermost first
};

}  // namespace coseg
