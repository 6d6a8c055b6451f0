#pragma once
// Feature matrices with what is known about their columns, and the coefficients found for them, as HDF5. Layouts:
// docs/formats.md.

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace coseg {

/// Two items and how much they belong together beside what the features say.
struct ItemPairs {
    std::vector<int> first;
    std::vector<int> second;
    std::vector<double> weight;
};

struct FeatureFile {
    std::vector<std::string> names;         ///< of the features, in byte order
    std::vector<Eigen::MatrixXd> features;  ///< d_h x N each; their N may differ: the solver refuses that
    std::vector<int> mesh_of;             ///< N, or empty: the mesh (or whatever group) of each item, from 0
    std::vector<std::string> mesh_names;  ///< of each group, or empty
    std::vector<double> patch_area;       ///< N, or empty
    ItemPairs neighbors;                  ///< boundary lengths; may be empty
    std::vector<double> concavity;        ///< of neighbors
    ItemPairs overlaps;                   ///< intersections over unions; may be empty
};

/// Reads the group `features` and what else of the layout is there, from any HDF5 file. Throws Error(input) where the
/// file cannot be read or its parts do not fit together (lengths, numbers of items). The matrices' values are the
/// solver's to check.
FeatureFile read_feature_file(const std::string& path);

/// Throws Error(output).
void write_feature_file(const std::string& path, const FeatureFile& file);

/// W by columns: column j has the entries offsets[j] .. offsets[j + 1]; entry e is row rows[e] with `features` values.
struct CoefficientFile {
    std::int64_t size = 0;
    int features = 1;
    std::vector<std::int64_t> offsets;
    std::vector<int> rows;
    std::vector<double> values;
    double objective = 0.0;
    double lower_bound = 0.0;
    std::string reason;  ///< why the solver stopped
};

/// Throws Error(output).
void write_coefficient_file(const std::string& path, const CoefficientFile& file);

}  // namespace coseg
