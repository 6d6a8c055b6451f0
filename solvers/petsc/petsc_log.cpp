#include "solvers/petsc/petsc_log.hpp"

#include <petsclog.h>
#include <petscviewer.h>

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "solvers/petsc/petsc_handle.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

/// A file that is memory, because PETSc writes its log to files only.
class MemoryFile {
  public:
    MemoryFile() : file_(open_memstream(&text_, &size_)) {}
    ~MemoryFile() {
        if (file_ != nullptr) std::fclose(file_);
        std::free(text_);  // NOLINT(cppcoreguidelines-no-malloc): open_memstream's own
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    [[nodiscard]] FILE* file() const noexcept { return file_; }
    [[nodiscard]] std::string text() const {
        std::fflush(file_);
        return {text_, size_};
    }

  private:
    char* text_ = nullptr;
    std::size_t size_ = 0;
    FILE* file_;
};

using Viewer = PetscHandle<PetscViewer, PetscViewerDestroy>;

}  // namespace

void begin_petsc_log() { check(PetscLogDefaultBegin(), "PetscLogDefaultBegin"); }

std::string petsc_log_text(const Comm& comm) {
    const MemoryFile memory;
    agree(comm, [&] {
        if (memory.file() == nullptr)
            throw Error(ExitCode::internal, "no memory for PETSc's log; leave out --profile");
    });
    PetscViewer raw = nullptr;
    check(PetscViewerASCIIOpenWithFILE(comm.raw(), memory.file(), &raw), "PetscViewerASCIIOpenWithFILE");
    const Viewer viewer(raw);
    check(PetscLogView(viewer.get()), "PetscLogView");
    return comm.is_root() ? memory.text() : std::string();
}

}  // namespace coseg
