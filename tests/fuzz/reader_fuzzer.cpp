// Gives a reader bytes that libFuzzer makes up (tests/fuzz/run.sh). The variable COSEG_FUZZED says which
// reader: the suffix of a mesh format, or one of those in `file_readers`. Whatever the bytes are, the reader
// must return what its header says, or throw Error(input) with a sentence.

#include <sys/mman.h>
#include <unistd.h>

#include <cinttypes>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "io/data_files/alignment_file.hpp"
#include "io/data_files/correction_file.hpp"
#include "io/data_files/face_feature_file.hpp"
#include "io/data_files/feature_file.hpp"
#include "io/data_files/label_file.hpp"
#include "io/data_files/name_file.hpp"
#include "io/data_files/problem_file.hpp"
#include "io/files/content_hash.hpp"
#include "io/files/hdf5_file.hpp"
#include "io/files/record_file.hpp"
#include "io/folders/finished_run.hpp"
#include "io/mesh_files/mesh_reader.hpp"
#include "src/base/error.hpp"
#include "src/base/text.hpp"
#include "tests/support/every_kind.hpp"

namespace {

using coseg::PolygonMesh;

void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

void require_sound(const PolygonMesh& mesh) {
    require(mesh.face_count() >= 1 && mesh.offsets.front() == 0, "a mesh without faces");
    require(mesh.offsets.back() == static_cast<int>(mesh.corners.size()),
            "offsets that do not end at the corners");
    for (int f = 0; f < mesh.face_count(); ++f)
        require(mesh.offsets[static_cast<std::size_t>(f)] <= mesh.offsets[static_cast<std::size_t>(f) + 1],
                "offsets that fall");
    for (const int corner : mesh.corners)
        require(corner >= 0 && corner < mesh.vertex_count(), "a corner that is no vertex");
    for (const Eigen::Vector3d& p : mesh.vertices)
        require(p.allFinite() && p.cwiseAbs().maxCoeff() <= 1e37, "a coordinate beyond the limits");
}

/// The path of a file in memory with these bytes, for readers that open a file themselves.
class MemoryFile {
  public:
    explicit MemoryFile(std::string_view bytes) : file_(memfd_create("fuzzed", 0)) {
        require(file_ >= 0, "no file in memory");
        require(write(file_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()), "no memory");
    }
    ~MemoryFile() { close(file_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

  private:
    int file_;
};

/// The report of a run must say what the commands that read it rely on.
void read_report(const std::string& path) {
    static const std::string folder = [] {
        char name[] = "/tmp/coseg_fuzzed_XXXXXX";
        require(mkdtemp(name) != nullptr, "no folder");
        return std::string(name);
    }();
    static const std::string report = folder + "/report.json";
    std::filesystem::remove(report);
    std::filesystem::create_symlink(path, report);
    const coseg::FinishedRun run = coseg::read_finished_run(folder);
    require(run.parts >= 1 && std::ssize(run.part_area) == run.parts && !run.shapes.empty(),
            "a run without parts or shapes");
}

void read_npy(std::string_view bytes) {
    constexpr int faces = 4;
    const Eigen::MatrixXf features = coseg::parse_npy_features(bytes, "fuzzed.npy", faces);
    require(features.cols() == faces && features.allFinite(), "features that are not of the faces");
}

/// The bytes of an HDF5 file with the first line that coseg gives it. Without it nearly every file would be
/// refused for its checksum.
std::string with_first_line(std::string_view bytes) {
    constexpr std::size_t user_block = 512;
    if (!bytes.starts_with("coseg hdf5 1") || bytes.size() < user_block) return std::string(bytes);
    const std::string_view content = bytes.substr(user_block);
    char line[user_block] = {};
    std::snprintf(line, sizeof line, "coseg hdf5 1 bytes=%" PRIu64 " xxh3=%s\n",
                  static_cast<std::uint64_t>(content.size()), coseg::hash_bytes(content).hex().c_str());
    return std::string(line, sizeof line) + std::string(content);
}

/// Records with fields of every kind, as files of the state folder and models hold them.
void read_records(const std::string& path) {
    const coseg::Hdf5Reader file(path, "coseg fuzzed", 1);
    for (const std::string& name : file.names("/")) require(!name.empty(), "a member without a name");
    const auto rows = coseg::read_column<coseg::test::EveryKind>(file, "rows");
    coseg::test::EveryKind record;
    coseg::read_record(file, "record", record);
    for (const std::vector<int>& list : record.lists)
        require(list.size() <= 1U << 24U, "more values than the file can hold");
    require(rows.size() <= 1U << 24U, "more rows than the file can hold");
}

void read_features(const std::string& path) {
    const coseg::FeatureFile file = coseg::read_feature_file(path);
    require(!file.features.empty() && file.names.size() == file.features.size(), "no features");
    const auto items = file.features.front().cols();
    for (const auto* pairs : {&file.neighbors, &file.overlaps}) {
        for (const int second : pairs->second)
            require(second > 0 && second < items, "a pair beyond the items");
    }
    require(file.mesh_of.empty() || std::ssize(file.mesh_of) == items, "meshes of other items");
}

/// Readers that open a file themselves, by the suffix of the examples in tests/corpus.
using FileReader = void (*)(const std::string& path);
const std::map<std::string, FileReader> file_readers{
    {".seg", [](const std::string& path) { coseg::read_labels(path, -1); }},
    {".txt", [](const std::string& path) { coseg::read_names(path); }},
    {".report", read_report},
    {".corrections", [](const std::string& path) { coseg::read_corrections(path); }},
    {".constraints", [](const std::string& path) { coseg::read_constraints(path); }},
    {".alignment", [](const std::string& path) { coseg::read_alignment(path); }},
    {".problem", [](const std::string& path) { coseg::read_problem_file(path); }},
    {".features", read_features},
    {".face_features", [](const std::string& path) { coseg::read_face_features(path, 4); }},
    {".records", read_records}};

/// The suffix of what is fuzzed.
const std::string& fuzzed_suffix() {
    static const std::string suffix = [] {
        const char* given = std::getenv("COSEG_FUZZED");
        require(given != nullptr, "COSEG_FUZZED is not set");
        return std::string(given);
    }();
    return suffix;
}

void read(std::string_view bytes) {
    const std::string& suffix = fuzzed_suffix();
    const auto reader = file_readers.find(suffix);
    if (reader != file_readers.end()) {
        reader->second(MemoryFile(with_first_line(bytes)).path());
    } else if (suffix == ".npy") {
        read_npy(bytes);
    } else {
        const coseg::ParsedMesh parsed = coseg::parse_mesh(bytes, "fuzzed" + suffix);
        require_sound(parsed.mesh);
        for (const std::string& warning : parsed.warnings)
            require(warning.starts_with("fuzzed") && coseg::is_utf8(warning),
                    "a warning that is no sentence");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        read({reinterpret_cast<const char*>(data), size});
    } catch (const coseg::Error& error) {
        require(error.code() == coseg::ExitCode::input, "an error of another kind than of the input");
        require(std::string_view(error.what()).size() > 20, "an error that is no sentence");
    }
    return 0;
}
