#pragma once
// Writes files that are there whole or not at all.

#include <fstream>
#include <string>
#include <string_view>

namespace coseg {

/// Writes under a temporary name in the same folder. commit() gives the file its name and replaces an older
/// one. Without commit (after an exception) the temporary file is removed, and an older file stays as it was.
/// Where the path is a link, what it leads to is replaced. A pipe or a device is written to as it is.
class AtomicFile {
  public:
    /// Throws Error(output) with path and cause if the temporary cannot be created, or if no file can have
    /// this path, as where a folder has it or its name is too long.
    explicit AtomicFile(const std::string& path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    [[nodiscard]] std::ostream& stream() { return stream_; }

    /// Throws Error(output) with path and cause if anything could not be written (a full disk) or renamed.
    void commit();

  private:
    [[noreturn]] void fail(const std::string& what);
    void remove_temporary();

    std::string path_;
    std::string target_;     ///< what the path leads to
    std::string temporary_;  ///< "" where it leads to a pipe or a device
    std::ofstream stream_;
    bool is_committed_ = false;
};

/// Throws as AtomicFile does where a file at this path could not be written, so that a command says so before
/// its work and not after it. Nothing is left behind; a pipe or a device is not opened. "" is no file.
void try_file(const std::string& path);

/// Writes the whole content at once. Throws as AtomicFile does.
void write_file(const std::string& path, std::string_view content);

}  // namespace coseg
