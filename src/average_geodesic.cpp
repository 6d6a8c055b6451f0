#include "src/average_geodesic.hpp"

#include <algorithm>

namespace coseg {

Eigen::VectorXd average_geodesic(const GeodesicTable& table) {
    const Eigen::Index samples = table.distance.rows();
    Eigen::VectorXd average(table.distance.cols());
    for (Eigen::Index f = 0; f < average.size(); ++f) {
        double sum = 0.0;
        for (Eigen::Index k = 0; k < samples; ++k) {
            sum += table.sample_weight[k] * static_cast<double>(table.distance(k, f));
        }
        average[f] = sum;
    }
    if (average.size() > 0) average.array() -= average.minCoeff();
    return average;
}

}  // namespace coseg
