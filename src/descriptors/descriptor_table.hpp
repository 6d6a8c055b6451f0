#pragma once
// The table of the descriptors of a face, one row for each. Everything that runs over descriptors runs over
// this table.

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "src/descriptors/descriptor_context.hpp"

namespace coseg {

/// A number per face (F), or a vector per face (d x F, column major).
using FaceValues = std::variant<Eigen::VectorXd, Eigen::MatrixXf>;

/// How the values of faces become the bins of a patch's histogram. See RangeKind
/// (src/histograms/feature_range.hpp).
enum class BinKind {
    equal_mass,           ///< numbers; each bin holds the same share of the collection's area
    per_mesh_percentile,  ///< numbers, rescaled by each mesh's 1st and 99th percentile; bins of equal width
    global_percentile,    ///< numbers; bins of equal width between the collection's percentiles
    words                 ///< vectors, grouped by k-means over the collection; a bin is a word
};

/// The weight of a descriptor when one of several partitions is chosen. See BetweenPartVariance
/// (src/records/start_outcome.hpp).
struct PartitionWeight {
    double pooled = 0.0;
    double per_mesh = 0.0;
};

struct Descriptor {
    std::string name;    ///< in options, files and pictures
    std::string phrase;  ///< in sentences: "shape diameter"
    BinKind bins = BinKind::per_mesh_percentile;
    double weight = 0.0;  ///< of the feature, where the user gives none; one of weight 0 is not computed then
    PartitionWeight partition{};
    SharedPart shared = SharedPart::none;  ///< what of the context it asks for
    const char* step = "";                 ///< of the work, for the table of times
    /// Values for the faces of a mesh, free of its scale; vectors exactly where `bins` are words. Null: given
    /// by the user.
    FaceValues (*values)(DescriptorContext& context) = nullptr;
    int given_dimensions = 0;  ///< numbers a face of values that the user gives; 0 for other rows
    /// Words only: one number per face that pictures and exports show.
    Eigen::VectorXd (*shown)(const Eigen::MatrixXf& values) = nullptr;
};

/// In the order in which features are numbered and --feature-weights are given.
const std::vector<Descriptor>& descriptor_table();

/// The row of what users give for every face, which a run adds to its table: numbers, or vectors of
/// `dimensions`. Numbers of all meshes are compared as they are.
inline constexpr const char* face_features_name = "face_features";
Descriptor face_features_descriptor(int dimensions, double weight);

/// Of every row of the table.
std::vector<std::string> descriptor_names();
std::vector<double> default_descriptor_weights();
/// 1 for each row that counts by default, 0 for the others.
std::vector<double> equal_descriptor_weights();

/// The values of one row of a table.
struct FaceDescriptor {
    int row = 0;
    FaceValues values;
};
/// Of one mesh: those rows that were computed, ascending.
using FaceDescriptors = std::vector<FaceDescriptor>;

/// The rows `chosen` of the table, numbers in ascending order. Rows that share a part of the context are
/// computed one after the other, and the part is freed before the next one is made. The context is told when
/// each row's step ends. Throws what the rows' functions do.
FaceDescriptors face_descriptors(DescriptorContext& context, const std::vector<int>& chosen);

/// The names of the steps of face_descriptors(context, chosen), in their order, each once.
std::vector<std::string> descriptor_steps(const std::vector<int>& chosen);

/// One number per face: the values themselves, or what `shown` says of vectors.
Eigen::VectorXd shown_values(const FaceDescriptor& descriptor);

}  // namespace coseg
