#include "src/patches/patch_label_areas.hpp"

#include "src/base/index.hpp"

namespace coseg {

Eigen::MatrixXd patch_label_areas(const std::vector<int>& patch_of_face, int count,
                                  const std::vector<int>& label_of_face, int labels,
                                  const Eigen::VectorXd& area) {
    Eigen::MatrixXd areas = Eigen::MatrixXd::Zero(labels, count);
    for (std::size_t f = 0; f < patch_of_face.size(); ++f) {
        if (label_of_face[f] >= 0)
            areas(label_of_face[f], patch_of_face[f]) += area(static_cast<Eigen::Index>(f));
    }
    return areas;
}

}  // namespace coseg
