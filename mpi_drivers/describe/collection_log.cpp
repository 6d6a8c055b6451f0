#include "mpi_drivers/describe/collection_log.hpp"

#include <algorithm>

#include "src/base/text.hpp"

namespace coseg {

std::string described_summary(const Collection& collection) {
    std::int64_t faces = 0;
    std::int64_t reused = 0;
    for (const MeshFacts& mesh : collection.meshes) {
        faces += mesh.input_faces;
        reused += mesh.reused ? 1 : 0;
    }
    return with_unit(static_cast<std::int64_t>(collection.meshes.size()), "shape", "shapes") + ", " +
           with_unit(faces, "face", "faces") + ", " +
           with_unit(collection.numbering.patch_count(), "patch", "patches") +
           (reused > 0 ? ", " + std::to_string(reused) + " from the state folder" : "");
}

void warn_of_meshes(const Collection& collection, const StageLog& log) {
    constexpr std::size_t shown = 10;
    std::vector<std::string> sentences;
    for (const SetAside& mesh : collection.set_aside) sentences.push_back("set aside: " + mesh.reason);
    for (const MeshFacts& mesh : collection.meshes)
        sentences.insert(sentences.end(), mesh.warnings.begin(), mesh.warnings.end());
    for (std::size_t k = 0; k < std::min(shown, sentences.size()); ++k) log.print_warning(sentences[k]);
    if (sentences.size() > shown) {
        log.print_warning(with_unit(static_cast<std::int64_t>(sentences.size() - shown), "more warning is",
                                    "more warnings are") +
                          " in the report");
    }
}

}  // namespace coseg
