// Gives a reader bytes that libFuzzer makes up (tests/fuzz/run.sh). The variable COSEG_FUZZED says which
// reader: the suffix of a mesh format, ".seg" for labels, or ".txt" for names. Whatever the bytes are, the
// reader must return what its header says, or throw Error(input) with a sentence.

#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "io/data_files/label_file.hpp"
#include "io/data_files/name_file.hpp"
#include "io/mesh_files/mesh_reader.hpp"
#include "src/base/error.hpp"
#include "src/base/text.hpp"

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
    if (suffix == ".seg") {
        coseg::read_labels(MemoryFile(bytes).path(), -1);
    } else if (suffix == ".txt") {
        coseg::read_names(MemoryFile(bytes).path());
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
