#include "io/files/hdf5_file.hpp"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <numeric>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "io/files/atomic_file.hpp"
#include "io/files/content_hash.hpp"
#include "io/files/file_contents.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

constexpr std::size_t user_block = 512;
constexpr const char* first_line = "coseg hdf5 1 bytes=%" PRIu64 " xxh3=%32[0-9a-f]";
constexpr std::size_t memory_increment = 1 << 16;

/// A handle of the HDF5 library and how it is given back.
class Handle {
  public:
    Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    ~Handle() { reset(); }
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(close_, other.close_);
        return *this;
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    void reset() noexcept {
        if (id_ >= 0) close_(std::exchange(id_, -1));
    }
    [[nodiscard]] hid_t id() const noexcept { return id_; }
    [[nodiscard]] bool ok() const noexcept { return id_ >= 0; }

  private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

/// The library's own error stack would go to standard error beside our sentence.
void silence_library() {
    static const herr_t done = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    static_cast<void>(done);
}

template <class T>
hid_t kind_of();
template <>
hid_t kind_of<float>() {
    return H5T_NATIVE_FLOAT;
}
template <>
hid_t kind_of<double>() {
    return H5T_NATIVE_DOUBLE;
}
template <>
hid_t kind_of<std::int8_t>() {
    return H5T_NATIVE_INT8;
}
template <>
hid_t kind_of<std::int32_t>() {
    return H5T_NATIVE_INT32;
}
template <>
hid_t kind_of<std::int64_t>() {
    return H5T_NATIVE_INT64;
}
template <>
hid_t kind_of<std::uint64_t>() {
    return H5T_NATIVE_UINT64;
}

Handle text_type() {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.id(), H5T_VARIABLE);
    H5Tset_cset(type.id(), H5T_CSET_UTF8);
    return type;
}

Handle simple_space(const Hdf5Shape& shape) {
    const std::vector<hsize_t> extent(shape.begin(), shape.end());
    return {H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose};
}

std::uint64_t product(const Hdf5Shape& shape) {
    return std::accumulate(shape.begin(), shape.end(), std::uint64_t{1}, std::multiplies<>());
}

[[noreturn]] void fail_making(const std::string& path, const std::string& what) {
    throw Error(ExitCode::internal, path + ": the HDF5 library cannot make " + what);
}

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
    throw Error(ExitCode::input, path + ": " + what);
}

/// One chunk of about a mebibyte along the first axis.
void set_compression(hid_t creation, const Hdf5Shape& shape, std::size_t value_bytes) {
    std::vector<hsize_t> chunk(shape.begin(), shape.end());
    const std::uint64_t row = std::max<std::uint64_t>(1, product(shape) / shape.front() * value_bytes);
    chunk.front() = std::clamp<std::uint64_t>((1 << 20) / row, 1, shape.front());
    H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data());
    H5Pset_shuffle(creation);
    H5Pset_deflate(creation, 1);
}

Handle creation_with_groups() {
    Handle list(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(list.id(), 1);
    return list;
}

/// Length and checksum, then the summary as far as there is room; zeros to the end.
std::string filled_user_block(std::string_view content, const std::string& summary) {
    char block[user_block] = {};
    std::snprintf(block, sizeof block, "coseg hdf5 1 bytes=%" PRIu64 " xxh3=%s\n%s",
                  static_cast<std::uint64_t>(content.size()), hash_bytes(content).hex().c_str(),
                  summary.c_str());
    return {block, sizeof block};
}

struct Expectation {
    std::uint64_t bytes = 0;
    std::string checksum;
};

/// What the first line promises; nothing if it is not ours.
bool parse_first_line(const char* block, Expectation& expected) {
    std::array<char, 33> hex{};
    if (std::sscanf(block, first_line, &expected.bytes, hex.data()) != 2) return false;
    expected.checksum = hex.data();
    return expected.checksum.size() == 32;
}

bool read_first_line(std::ifstream& file, Expectation& expected) {
    std::array<char, user_block + 1> block{};
    file.read(block.data(), user_block);
    return file.gcount() == static_cast<std::streamsize>(user_block) &&
           parse_first_line(block.data(), expected);
}

std::ifstream opened(const std::string& path) {
    require_regular_file(path);
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    file.peek();
    if (!file.is_open() || file.bad()) {
        refuse(path, std::string("cannot be read (") + std::strerror(errno != 0 ? errno : EIO) + ")");
    }
    file.clear();
    return file;
}

/// Compares the rest of the file with what its first line promises.
void compare(const std::string& path, std::ifstream& file, const Expectation& expected) {
    ContentHasher hasher;
    std::vector<char> piece(1 << 20);
    std::uint64_t bytes = 0;
    while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())), file.gcount() > 0) {
        hasher.add_bytes(piece.data(), static_cast<std::size_t>(file.gcount()));
        bytes += static_cast<std::uint64_t>(file.gcount());
    }
    if (bytes != expected.bytes) {
        refuse(path, "is damaged: " + std::to_string(bytes) + " bytes follow its first line, not " +
                         std::to_string(expected.bytes));
    }
    if (hasher.result().hex() != expected.checksum)
        refuse(path, "is damaged: its bytes do not have the checksum of its first line");
}

void check_content(const std::string& path, Hdf5Origin origin) {
    std::ifstream file = opened(path);
    Expectation expected;
    if (read_first_line(file, expected)) return compare(path, file, expected);
    if (origin == Hdf5Origin::ours) refuse(path, "is damaged: its first line is not that of a coseg file");
}

}  // namespace

struct Hdf5Writer::Handles {
    Handle file{-1, H5Fclose};
    Handle groups = creation_with_groups();
};

Hdf5Writer::Hdf5Writer(std::string path, const std::string& format, int version) : path_(std::move(path)) {
    silence_library();
    handles_ = std::make_unique<Handles>();
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_core(access.id(), memory_increment, 0);
    handles_->file = Handle(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose);
    if (!handles_->file.ok()) fail_making(path_, "a file in memory");
    attribute("format", format);
    attribute("format_version", static_cast<std::int64_t>(version));
    attribute("coseg_version", std::string(COSEG_VERSION));
}

Hdf5Writer::~Hdf5Writer() = default;

template <class T>
void Hdf5Writer::write(const std::string& name, std::span<const T> values, Hdf5Shape shape, bool compressed) {
    if (shape.empty()) shape = {values.size()};
    if (product(shape) != values.size()) fail_making(path_, name + ": its shape does not fit its values");
    const Handle space = simple_space(shape);
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation.id(), 0);  // the same content gives the same bytes
    if (compressed && !values.empty()) set_compression(creation.id(), shape, sizeof(T));
    const Handle set(H5Dcreate2(handles_->file.id(), name.c_str(), kind_of<T>(), space.id(),
                                handles_->groups.id(), creation.id(), H5P_DEFAULT),
                     H5Dclose);
    if (!set.ok() || H5Dwrite(set.id(), kind_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
        fail_making(path_, "the dataset " + name);
    }
}

template void Hdf5Writer::write(const std::string&, std::span<const float>, Hdf5Shape, bool);
template void Hdf5Writer::write(const std::string&, std::span<const double>, Hdf5Shape, bool);
template void Hdf5Writer::write(const std::string&, std::span<const std::int8_t>, Hdf5Shape, bool);
template void Hdf5Writer::write(const std::string&, std::span<const std::int32_t>, Hdf5Shape, bool);
template void Hdf5Writer::write(const std::string&, std::span<const std::int64_t>, Hdf5Shape, bool);
template void Hdf5Writer::write(const std::string&, std::span<const std::uint64_t>, Hdf5Shape, bool);

void Hdf5Writer::write_texts(const std::string& name, const std::vector<std::string>& texts) {
    std::vector<const char*> pointers;
    for (const std::string& text : texts) pointers.push_back(text.c_str());
    const Handle type = text_type();
    const Handle space = simple_space({texts.size()});
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation.id(), 0);
    const Handle set(H5Dcreate2(handles_->file.id(), name.c_str(), type.id(), space.id(),
                                handles_->groups.id(), creation.id(), H5P_DEFAULT),
                     H5Dclose);
    const bool written = set.ok() && (texts.empty() || H5Dwrite(set.id(), type.id(), H5S_ALL, H5S_ALL,
                                                                H5P_DEFAULT, pointers.data()) >= 0);
    if (!written) fail_making(path_, "the dataset " + name);
}

namespace {

void write_attribute(const std::string& path, hid_t file, const std::string& name, hid_t type,
                     const void* value) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate2(file, name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    if (!attribute.ok() || H5Awrite(attribute.id(), type, value) < 0)
        fail_making(path, "the attribute " + name);
}

}  // namespace

void Hdf5Writer::attribute(const std::string& name, std::int64_t value) {
    write_attribute(path_, handles_->file.id(), name, H5T_NATIVE_INT64, &value);
}

void Hdf5Writer::attribute(const std::string& name, double value) {
    write_attribute(path_, handles_->file.id(), name, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5Writer::attribute(const std::string& name, const std::string& value) {
    const Handle type = text_type();
    const char* pointer = value.c_str();
    write_attribute(path_, handles_->file.id(), name, type.id(), &pointer);
}

void Hdf5Writer::summary(const std::string& line) { summary_ = line; }

void Hdf5Writer::commit() {
    const hid_t file = handles_->file.id();
    H5Fflush(file, H5F_SCOPE_LOCAL);
    const ssize_t size = H5Fget_file_image(file, nullptr, 0);
    if (size <= 0) fail_making(path_, "an image of the file");
    std::string image(static_cast<std::size_t>(size), '\0');
    if (H5Fget_file_image(file, image.data(), image.size()) != size)
        fail_making(path_, "an image of the file");
    handles_.reset();
    // The library finds the file's begin behind a user block by itself, and images with one come out short.
    AtomicFile output(path_);
    const std::string block = filled_user_block(image, summary_);
    output.stream().write(block.data(), static_cast<std::streamsize>(block.size()));
    output.stream().write(image.data(), static_cast<std::streamsize>(image.size()));
    output.commit();
}

namespace {

/// How many values a dataset may have: a file is believed no further than it is long. Deflated data grow at
/// most 1032 times; what was never written takes no room at all.
std::uint64_t most_values(hid_t set, hid_t file) {
    constexpr std::uint64_t growth = 1032;
    constexpr std::uint64_t always = 1 << 20;  // bytes
    hsize_t bytes = 0;
    H5Fget_filesize(file, &bytes);
    const std::uint64_t stored = std::min<std::uint64_t>(bytes, H5Dget_storage_size(set));
    const Handle creation(H5Dget_create_plist(set), H5Pclose);
    const Handle type(H5Dget_type(set), H5Tclose);
    const std::uint64_t most = (H5Pget_layout(creation.id()) == H5D_CHUNKED ? growth : 1) * stored;
    return std::max(most, always) / std::max<std::uint64_t>(1, H5Tget_size(type.id()));
}

/// The number of values; nothing if there are more than `most`, or more than can be counted.
std::optional<std::uint64_t> counted_values(const Hdf5Shape& shape, std::uint64_t most) {
    if (std::ranges::find(shape, std::uint64_t{0}) != shape.end()) return 0;
    std::uint64_t count = 1;
    for (const std::uint64_t extent : shape) {
        if (extent > most / count) return std::nullopt;
        count *= extent;
    }
    return count;
}

std::string file_name_of(hid_t object) {
    std::string name(static_cast<std::size_t>(std::max<ssize_t>(H5Fget_name(object, nullptr, 0), 0)), '\0');
    H5Fget_name(object, name.data(), name.size() + 1);
    return name;
}

/// Whether the values of a dataset lie in other files than its own: behind a link, as raw bytes, or as a
/// view.
bool is_elsewhere(hid_t set, hid_t file) {
    const Handle creation(H5Dget_create_plist(set), H5Pclose);
    return H5Pget_external_count(creation.id()) != 0 || H5Pget_layout(creation.id()) == H5D_VIRTUAL ||
           file_name_of(set) != file_name_of(file);
}

}  // namespace

struct Hdf5Reader::Handles {
    Handle file{-1, H5Fclose};

    [[nodiscard]] Handle dataset(const std::string& path, const std::string& name) const {
        Handle set(H5Dopen2(file.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
        if (!set.ok()) refuse(path, "has no dataset '" + name + "'");
        if (is_elsewhere(set.id(), file.id()))
            refuse(path, "the dataset '" + name + "' lies in another file; copy it into this one");
        return set;
    }

    [[nodiscard]] std::size_t count(const std::string& path, const std::string& name, const Handle& set,
                                    const Hdf5Shape& shape) const {
        const std::optional<std::uint64_t> values = counted_values(shape, most_values(set.id(), file.id()));
        if (!values) refuse(path, "the dataset '" + name + "' promises more values than the file can hold");
        return *values;
    }

    [[nodiscard]] Handle attribute(const std::string& path, const std::string& name) const {
        Handle found(H5Aopen(file.id(), name.c_str(), H5P_DEFAULT), H5Aclose);
        if (!found.ok()) refuse(path, "has no attribute '" + name + "'");
        const Handle space(H5Aget_space(found.id()), H5Sclose);
        if (H5Sget_simple_extent_npoints(space.id()) != 1)
            refuse(path, "the attribute '" + name + "' is not a single value");
        return found;
    }
};

Hdf5Reader::Hdf5Reader(std::string path, Hdf5Origin origin)
    : path_(std::move(path)), handles_(std::make_unique<Handles>()) {
    silence_library();
    check_content(path_, origin);
    handles_->file = Handle(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (!handles_->file.ok()) refuse(path_, "is not an HDF5 file");
}

Hdf5Reader::Hdf5Reader(std::string path, const std::string& format, int version)
    : Hdf5Reader(std::move(path), Hdf5Origin::ours) {
    if (text("format") != format) refuse(path_, "holds '" + text("format") + "', not '" + format + "'");
    if (integer("format_version") != version) {
        refuse(path_, "has version " + std::to_string(integer("format_version")) + " of the format '" +
                          format + "'; this program reads version " + std::to_string(version));
    }
}

Hdf5Reader::~Hdf5Reader() = default;

bool Hdf5Reader::has(const std::string& name) const {
    for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
        if (H5Lexists(handles_->file.id(), name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
        if (end == std::string::npos) return true;
    }
}

std::vector<std::string> Hdf5Reader::names(const std::string& group) const {
    const Handle opened_group(H5Gopen2(handles_->file.id(), group.c_str(), H5P_DEFAULT), H5Gclose);
    H5G_info_t info{};
    if (!opened_group.ok() || H5Gget_info(opened_group.id(), &info) < 0)
        refuse(path_, "has no group '" + group + "'");
    std::vector<std::string> found;
    for (hsize_t k = 0; k < info.nlinks; ++k) {
        const ssize_t length = H5Lget_name_by_idx(opened_group.id(), ".", H5_INDEX_NAME, H5_ITER_INC, k,
                                                  nullptr, 0, H5P_DEFAULT);
        std::string name(static_cast<std::size_t>(std::max<ssize_t>(length, 0)), '\0');
        H5Lget_name_by_idx(opened_group.id(), ".", H5_INDEX_NAME, H5_ITER_INC, k, name.data(),
                           name.size() + 1, H5P_DEFAULT);
        found.push_back(std::move(name));
    }
    return found;
}

Hdf5Shape Hdf5Reader::shape(const std::string& name) const {
    const Handle set = handles_->dataset(path_, name);
    const Handle space(H5Dget_space(set.id()), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space.id());
    if (rank < 0) refuse(path_, "the dataset '" + name + "' has no shape");
    std::vector<hsize_t> extent(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space.id(), extent.data(), nullptr);
    return {extent.begin(), extent.end()};
}

template <class T>
std::vector<T> Hdf5Reader::read(const std::string& name) const {
    const Handle set = handles_->dataset(path_, name);
    const Handle type(H5Dget_type(set.id()), H5Tclose);
    const H5T_class_t kind = H5Tget_class(type.id());
    if (kind != H5T_INTEGER && kind != H5T_FLOAT)
        refuse(path_, "the dataset '" + name + "' does not hold numbers");
    if (std::is_integral_v<T> && kind == H5T_FLOAT)
        refuse(path_, "the dataset '" + name + "' holds floating-point numbers, not integers");
    std::vector<T> values(handles_->count(path_, name, set, shape(name)));
    if (H5Dread(set.id(), kind_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
        refuse(path_, "the dataset '" + name + "' cannot be read");
    return values;
}

template std::vector<float> Hdf5Reader::read(const std::string&) const;
template std::vector<double> Hdf5Reader::read(const std::string&) const;
template std::vector<std::int8_t> Hdf5Reader::read(const std::string&) const;
template std::vector<std::int32_t> Hdf5Reader::read(const std::string&) const;
template std::vector<std::int64_t> Hdf5Reader::read(const std::string&) const;
template std::vector<std::uint64_t> Hdf5Reader::read(const std::string&) const;

template <class T>
Eigen::MatrixX<T> Hdf5Reader::read_matrix(const std::string& name) const {
    const Hdf5Shape extent = shape(name);
    if (extent.size() != 2)
        refuse(path_, "the dataset '" + name + "' has " + std::to_string(extent.size()) + " axes, not 2");
    const std::vector<T> values = read<T>(name);
    return Eigen::Map<const Eigen::MatrixX<T>>(values.data(), static_cast<Eigen::Index>(extent[1]),
                                               static_cast<Eigen::Index>(extent[0]));
}

template Eigen::MatrixXd Hdf5Reader::read_matrix(const std::string&) const;
template Eigen::MatrixXf Hdf5Reader::read_matrix(const std::string&) const;

namespace {

/// Texts of any length, as this program writes them. Nothing where they cannot be read.
std::optional<std::vector<std::string>> texts_of_any_length(hid_t set, std::size_t count) {
    const Handle type = text_type();
    std::vector<char*> pointers(count, nullptr);
    if (count > 0 &&
        H5Dread(set, type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, static_cast<void*>(pointers.data())) < 0)
        return std::nullopt;
    std::vector<std::string> texts;
    for (char* pointer : pointers) {
        texts.emplace_back(pointer != nullptr ? pointer : "");
        H5free_memory(pointer);
    }
    return texts;
}

/// Texts that are filled up to one length, by zero bytes or by spaces, as NumPy and Fortran write them: the
/// library does not convert these to the others.
std::optional<std::vector<std::string>> texts_of_one_length(hid_t set, hid_t stored, std::size_t count) {
    const std::size_t length = H5Tget_size(stored);
    std::string bytes(count * length, '\0');
    if (count > 0 && H5Dread(set, stored, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0)
        return std::nullopt;
    const bool has_spaces = H5Tget_strpad(stored) == H5T_STR_SPACEPAD;
    std::vector<std::string> texts;
    for (std::size_t k = 0; k < count; ++k) {
        std::string text = bytes.substr(k * length, length);
        text.resize(std::min(text.find('\0'), text.size()));
        if (has_spaces) text.resize(text.find_last_not_of(' ') + 1);
        texts.push_back(std::move(text));
    }
    return texts;
}

}  // namespace

std::vector<std::string> Hdf5Reader::read_texts(const std::string& name) const {
    const Handle set = handles_->dataset(path_, name);
    const Handle stored(H5Dget_type(set.id()), H5Tclose);
    if (H5Tget_class(stored.id()) != H5T_STRING)
        refuse(path_, "the dataset '" + name + "' does not hold texts");
    const std::size_t count = handles_->count(path_, name, set, shape(name));
    std::optional<std::vector<std::string>> texts = H5Tis_variable_str(stored.id()) > 0
                                                        ? texts_of_any_length(set.id(), count)
                                                        : texts_of_one_length(set.id(), stored.id(), count);
    if (!texts) refuse(path_, "the dataset '" + name + "' cannot be read");
    return std::move(*texts);
}

std::int64_t Hdf5Reader::integer(const std::string& name) const {
    const Handle attribute = handles_->attribute(path_, name);
    std::int64_t value = 0;
    if (H5Aread(attribute.id(), H5T_NATIVE_INT64, &value) < 0)
        refuse(path_, "the attribute '" + name + "' is not a number");
    return value;
}

double Hdf5Reader::number(const std::string& name) const {
    const Handle attribute = handles_->attribute(path_, name);
    double value = 0.0;
    if (H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value) < 0)
        refuse(path_, "the attribute '" + name + "' is not a number");
    return value;
}

std::string Hdf5Reader::text(const std::string& name) const {
    const Handle attribute = handles_->attribute(path_, name);
    const Handle stored(H5Aget_type(attribute.id()), H5Tclose);
    const Handle type = text_type();
    char* pointer = nullptr;
    if (H5Tget_class(stored.id()) != H5T_STRING || H5Tis_variable_str(stored.id()) <= 0 ||
        H5Aread(attribute.id(), type.id(), static_cast<void*>(&pointer)) < 0) {
        refuse(path_, "the attribute '" + name + "' is not a text");
    }
    std::string value = pointer != nullptr ? pointer : "";
    H5free_memory(pointer);
    return value;
}

std::string read_summary(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::array<char, user_block + 1> block{};
    file.read(block.data(), user_block);
    const std::string text = block.data();
    const std::size_t end = text.find('\n');
    return end == std::string::npos ? "" : text.substr(end + 1);
}

void verify_checksum(const std::string& path) { check_content(path, Hdf5Origin::ours); }

}  // namespace coseg
