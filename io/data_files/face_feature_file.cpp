#include "io/data_files/face_feature_file.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <vector>

#include "io/files/file_contents.hpp"
#include "io/files/hdf5_file.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_features(const std::string& path, const std::string& what) {
    throw Error(ExitCode::input, path + ": " + what);
}

/// What the header of a NumPy file says.
struct NpyHeader {
    std::string kind;
    bool is_fortran = false;
    std::vector<std::uint64_t> shape;
    std::size_t data = 0;  // where the values begin
};

std::uint64_t little_endian(std::string_view bytes) {
    std::uint64_t number = 0;
    for (std::size_t k = bytes.size(); k-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[k]);
    return number;
}

/// What stands behind 'key': in the header, a dictionary as Python prints it.
std::optional<std::string_view> value_of(std::string_view header, const std::string& key) {
    const std::size_t place = header.find("'" + key + "':");
    if (place == std::string_view::npos) return std::nullopt;
    std::string_view rest = header.substr(place + key.size() + 3);
    rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
    return rest;
}

/// The numbers in "(10, 3)".
std::optional<std::vector<std::uint64_t>> tuple_of(std::string_view text) {
    constexpr std::uint64_t most = std::uint64_t{1} << 40;
    std::vector<std::uint64_t> numbers;
    bool in_number = false;
    if (!text.starts_with('(')) return std::nullopt;
    for (const char c : text.substr(1)) {
        if (c == ')') return numbers;
        if (c >= '0' && c <= '9') {
            if (!in_number) numbers.push_back(0);
            numbers.back() = numbers.back() * 10 + static_cast<std::uint64_t>(c - '0');
            if (numbers.back() > most) return std::nullopt;
        } else if (c != ',' && c != ' ') {
            return std::nullopt;
        }
        in_number = c >= '0' && c <= '9';
    }
    return std::nullopt;
}

NpyHeader npy_header(std::string_view bytes, const std::string& path) {
    constexpr std::string_view magic = "\x93NUMPY";
    constexpr std::size_t start = 8;  // magic and version
    if (!bytes.starts_with(magic) || bytes.size() < start + 4)
        refuse_features(path, "is no NumPy file; write it with numpy.save");
    const bool is_first = bytes[6] == 1;
    if (bytes[6] < 1 || bytes[6] > 3)
        refuse_features(path, "is of an unknown version of the NumPy format; write it with numpy.save");
    const std::size_t width = is_first ? 2 : 4;
    const std::uint64_t length = little_endian(bytes.substr(start, width));
    if (length > bytes.size() - start - width) refuse_features(path, "ends within its header");
    const std::string_view text = bytes.substr(start + width, length);
    const auto kind = value_of(text, "descr");
    const auto order = value_of(text, "fortran_order");
    const auto shape = value_of(text, "shape");
    const auto numbers = shape ? tuple_of(*shape) : std::nullopt;
    if (!kind || !order || !numbers)
        refuse_features(path, "has a header that cannot be read; write it with numpy.save");
    return {std::string(kind->substr(0, std::min<std::size_t>(kind->find_first_of(",}"), 40))),
            order->starts_with("True"), *numbers, start + width + length};
}

/// The number of values a face.
std::uint64_t checked_width(const std::vector<std::uint64_t>& shape, const std::string& path, int faces) {
    if (shape.empty() || shape.size() > 2)
        refuse_features(path, "holds an array of " + std::to_string(shape.size()) +
                                  " dimensions; one or two are wanted, faces x numbers");
    if (shape[0] != static_cast<std::uint64_t>(faces))
        refuse_features(path, "holds " + std::to_string(shape[0]) + " rows, but the mesh file has " +
                                  std::to_string(faces) + " faces");
    const std::uint64_t width = shape.size() == 2 ? shape[1] : 1;
    if (width < 1 || width > 100'000)
        refuse_features(path, "holds " + std::to_string(width) + " numbers a face; 1 to 100000 are allowed");
    return width;
}

void check_finite(const Eigen::MatrixXf& features, const std::string& path) {
    for (Eigen::Index f = 0; f < features.cols(); ++f) {
        if (!features.col(f).allFinite())
            refuse_features(path, "row " + std::to_string(f + 1) +
                                      " holds a number that is not finite in single precision");
    }
}

template <class T>
Eigen::MatrixXf matrix_of(std::string_view data, Eigen::Index width, Eigen::Index faces, bool is_fortran) {
    std::vector<T> values(data.size() / sizeof(T));
    std::memcpy(values.data(), data.data(), data.size());
    using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
    // Rows of the file one after the other are columns of the result.
    if (!is_fortran) return Eigen::Map<const Matrix>(values.data(), width, faces).template cast<float>();
    return Eigen::Map<const Matrix>(values.data(), faces, width).transpose().template cast<float>();
}

Eigen::MatrixXf read_hdf5_features(const std::string& path, int faces) {
    const Hdf5Reader file(path, Hdf5Origin::foreign);
    if (!file.has("features")) refuse_features(path, "holds no dataset 'features'");
    const auto width = static_cast<Eigen::Index>(checked_width(file.shape("features"), path, faces));
    const std::vector<float> values = file.read<float>("features");
    return Eigen::Map<const Eigen::MatrixXf>(values.data(), width, faces);
}

}  // namespace

std::string face_feature_path(const std::string& folder, const std::string& name) {
    const std::string npy = (fs::path(folder) / (name + ".npy")).string();
    const std::string hdf5 = (fs::path(folder) / (name + ".h5")).string();
    std::error_code ignored;
    const bool has_npy = fs::exists(npy, ignored);
    const bool has_hdf5 = fs::exists(hdf5, ignored);
    if (has_npy && has_hdf5)
        throw Error(ExitCode::input, "both " + npy + " and " + hdf5 + " are there; keep one of them");
    if (!has_npy && !has_hdf5)
        throw Error(ExitCode::input,
                    "neither " + npy + " nor " + hdf5 + " is there: every mesh needs one of them");
    return has_npy ? npy : hdf5;
}

Eigen::MatrixXf parse_npy_features(std::string_view bytes, const std::string& path, int faces) {
    const NpyHeader header = npy_header(bytes, path);
    const std::uint64_t width = checked_width(header.shape, path, faces);
    const bool is_single = header.kind == "'<f4'";
    if (!is_single && header.kind != "'<f8'")
        refuse_features(
            path, "holds values of kind " + header.kind + "; save them as float32 or float64, little endian");
    const std::uint64_t wanted = width * static_cast<std::uint64_t>(faces) * (is_single ? 4 : 8);
    const std::string_view data = bytes.substr(header.data);
    if (data.size() != wanted) {
        refuse_features(path, "holds " + std::to_string(data.size()) +
                                  " bytes of values where its header asks for " + std::to_string(wanted));
    }
    const auto rows = static_cast<Eigen::Index>(width);
    Eigen::MatrixXf features = is_single ? matrix_of<float>(data, rows, faces, header.is_fortran)
                                         : matrix_of<double>(data, rows, faces, header.is_fortran);
    check_finite(features, path);
    return features;
}

Eigen::MatrixXf read_face_features(const std::string& path, int faces) {
    if (fs::path(path).extension() == ".npy") return parse_npy_features(read_regular_file(path), path, faces);
    Eigen::MatrixXf features = read_hdf5_features(path, faces);
    check_finite(features, path);
    return features;
}

}  // namespace coseg
