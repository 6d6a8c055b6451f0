#pragma once
// Reads and writes HDF5 files. Those of coseg are there whole or not at all and carry a checksum of every
// byte; those of others can be read as well.

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace coseg {

/// Names are paths inside the file ("patches/0"). Groups on the way are made as needed. Shapes are in C
/// order, as h5dump and h5py show them: a column-major `rows x cols` matrix of ours has the shape {cols,
/// rows}.
using Hdf5Shape = std::vector<std::uint64_t>;

/// Writes one file. The values are of the types float, double, std::int8_t, std::int32_t, std::int64_t,
/// std::uint64_t.
///
/// The file is kept in memory until commit() writes it under a temporary name and renames it. The first 512
/// bytes (HDF5's user block, which h5dump and h5py skip) hold one line of text: length and XXH3 checksum of
/// all bytes after them. Root attributes: `format`, `format_version`, `coseg_version`. Not collective; one
/// rank writes a file.
class Hdf5Writer {
  public:
    /// format says what the file holds, for example "coseg mesh description". version is that of this layout.
    Hdf5Writer(std::string path, const std::string& format, int version);
    ~Hdf5Writer();
    Hdf5Writer(const Hdf5Writer&) = delete;
    Hdf5Writer& operator=(const Hdf5Writer&) = delete;

    /// The product of the shape must be the number of values; an empty shape means {values.size()}. With
    /// `compressed` the data are shuffled and deflated, which pays for large data with many equal values.
    template <class T>
    void write(const std::string& name, std::span<const T> values, Hdf5Shape shape = {},
               bool compressed = false);
    template <class T>
    void write(const std::string& name, const std::vector<T>& values, Hdf5Shape shape = {},
               bool compressed = false) {
        write(name, std::span<const T>(values), std::move(shape), compressed);
    }
    /// Shape {cols, rows}; double or float.
    template <class T>
    void write_matrix(const std::string& name, const Eigen::MatrixX<T>& matrix, bool compressed = false) {
        write(name, std::span<const T>(matrix.data(), static_cast<std::size_t>(matrix.size())),
              {static_cast<std::uint64_t>(matrix.cols()), static_cast<std::uint64_t>(matrix.rows())},
              compressed);
    }
    /// Writes UTF-8 texts of any length.
    void write_texts(const std::string& name, const std::vector<std::string>& texts);

    /// Attributes of the root.
    void attribute(const std::string& name, std::int64_t value);
    void attribute(const std::string& name, double value);
    void attribute(const std::string& name, const std::string& value);

    /// Sets a line for listings, the second line of the user block. read_summary() finds it without opening
    /// the file.
    void summary(const std::string& line);

    /// Writes the file. Throws Error(output) with path and cause (a full disk, a folder that cannot be
    /// written); an older file of that name then stays as it was.
    void commit();

  private:
    struct Handles;
    std::string path_;
    std::string summary_;
    std::unique_ptr<Handles> handles_;
};

/// What a file must satisfy before its content is read.
enum class Hdf5Origin {
    ours,     ///< length and checksum must agree
    foreign,  ///< any HDF5 file; checked like ours if it has our first line
};

/// A file to read. Every failure is an Error(input) whose sentence names the file and the dataset. A dataset
/// that promises more values than a file of this length can hold is refused, and one that lies in another
/// file, to which a file of a stranger could lead.
class Hdf5Reader {
  public:
    /// Opens a file of ours. Throws if it cannot be read, is no HDF5 file, is damaged (length, checksum), or
    /// holds another format or version.
    Hdf5Reader(std::string path, const std::string& format, int version);
    /// Opens a file; the caller checks format and version.
    Hdf5Reader(std::string path, Hdf5Origin origin);
    ~Hdf5Reader();
    Hdf5Reader(const Hdf5Reader&) = delete;
    Hdf5Reader& operator=(const Hdf5Reader&) = delete;

    [[nodiscard]] bool has(const std::string& name) const;
    /// Names in a group, in byte order; "/" is the root.
    [[nodiscard]] std::vector<std::string> names(const std::string& group) const;
    [[nodiscard]] Hdf5Shape shape(const std::string& name) const;

    /// All values of a dataset, converted to T where the file holds another kind of number.
    template <class T>
    [[nodiscard]] std::vector<T> read(const std::string& name) const;
    /// A dataset of shape {cols, rows} as a matrix of rows x cols; double or float.
    template <class T = double>
    [[nodiscard]] Eigen::MatrixX<T> read_matrix(const std::string& name) const;
    [[nodiscard]] std::vector<std::string> read_texts(const std::string& name) const;

    [[nodiscard]] std::int64_t integer(const std::string& name) const;
    [[nodiscard]] double number(const std::string& name) const;
    [[nodiscard]] std::string text(const std::string& name) const;

    [[nodiscard]] const std::string& path() const noexcept { return path_; }

  private:
    struct Handles;
    std::string path_;
    std::unique_ptr<Handles> handles_;
};

/// The summary of one of our files, "" if it has none or cannot be read.
std::string read_summary(const std::string& path);

/// Reads every byte of one of our files and compares length and checksum. Throws Error(input) saying what is
/// wrong.
void verify_checksum(const std::string& path);

}  // namespace coseg
