#include "src/mesh/geometry_versions.hpp"

#include <embree3/rtcore.h>

#include <OpenMesh/Core/System/config.h>

namespace coseg {

std::vector<std::pair<std::string, std::string>> geometry_library_versions() {
    return {{"Embree", RTC_VERSION_STRING},
            {"OpenMesh", std::to_string(OM_GET_VER) + "." + std::to_string(OM_GET_MAJ)}};
}

}  // namespace coseg
