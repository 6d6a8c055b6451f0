#include "src/descriptors/descriptor_table.hpp"

#include <algorithm>

#include "src/base/index.hpp"
#include "src/descriptors/average_geodesic.hpp"
#include "src/descriptors/conformal_factor.hpp"
#include "src/descriptors/gaussian_curvature.hpp"
#include "src/descriptors/shape_context.hpp"
#include "src/descriptors/shape_diameter.hpp"
#include "src/descriptors/wave_kernel_signature.hpp"

namespace coseg {

namespace {

std::vector<Descriptor> made_table() {
    using Context = DescriptorContext;
    return {
        {.name = "gaussian_curvature",
         .phrase = "curvature",
         .bins = BinKind::equal_mass,
         .weight = 1.0,
         .partition = {.pooled = 25.0, .per_mesh = 27.0},
         .step = "curvature",
         .values = [](Context& c) -> FaceValues { return gaussian_curvature(c.mesh(), c.geometry()); }},
        {.name = "shape_diameter",
         .phrase = "shape diameter",
         .weight = 0.5,
         .partition = {.pooled = 15.0, .per_mesh = 20.0},
         .step = "shape_diameter",
         .values = [](Context& c) -> FaceValues {
             return shape_diameter(c.mesh(), c.geometry(), c.graph());
         }},
        {.name = "average_geodesic",
         .phrase = "geodesic distance",
         .weight = 1.0,
         .shared = SharedPart::geodesics,
         .step = "contexts",
         .values = [](Context& c) -> FaceValues { return average_geodesic(c.geodesics()); }},
        {.name = "shape_context",
         .phrase = "shape context",
         .bins = BinKind::words,
         .weight = 2.0,
         .shared = SharedPart::geodesics,
         .step = "contexts",
         .values = [](Context& c) -> FaceValues {
             return shape_context(c.geodesics(), c.geometry().centroid, face_normals(c.mesh()));
         },
         .shown = shape_context_rings},
        {.name = "conformal_factor",
         .phrase = "conformal factor",
         .weight = 1.0,
         .step = "conformal_factor",
         .values = [](Context& c) -> FaceValues { return conformal_factor(c.mesh(), c.geometry()); }},
        {.name = "wave_kernel_signature",
         .phrase = "wave kernel signature",
         .bins = BinKind::words,
         .shared = SharedPart::spectrum,
         .step = "wave_kernel",
         .values = [](Context& c) -> FaceValues {
             return wave_kernel_signature(c.mesh(), c.geometry(), c.spectrum());
         },
         .shown = wave_kernel_level},
    };
}

const char* step_of(SharedPart part) {
    switch (part) {
        case SharedPart::none:
            return "";
        case SharedPart::geodesics:
            return "geodesics";
        case SharedPart::spectrum:
            return "spectrum";
    }
    return "";
}

/// By the shared part, so that no two of them are held at a time.
std::vector<int> in_order_of_work(std::vector<int> rows) {
    std::stable_sort(rows.begin(), rows.end(), [](int a, int b) {
        return descriptor_table()[at(a)].shared < descriptor_table()[at(b)].shared;
    });
    return rows;
}

}  // namespace

const std::vector<Descriptor>& descriptor_table() {
    static const std::vector<Descriptor> table = made_table();
    return table;
}

Descriptor face_features_descriptor(int dimensions, double weight) {
    return {.name = face_features_name,
            .phrase = "features given for faces",
            .bins = dimensions > 1 ? BinKind::words : BinKind::global_percentile,
            .weight = weight,
            .given_dimensions = dimensions};
}

std::vector<std::string> descriptor_names() {
    std::vector<std::string> names;
    for (const Descriptor& row : descriptor_table()) names.push_back(row.name);
    return names;
}

std::vector<double> default_descriptor_weights() {
    std::vector<double> weights;
    for (const Descriptor& row : descriptor_table()) weights.push_back(row.weight);
    return weights;
}

std::vector<double> equal_descriptor_weights() {
    std::vector<double> weights;
    for (const Descriptor& row : descriptor_table()) weights.push_back(row.weight > 0.0 ? 1.0 : 0.0);
    return weights;
}

FaceDescriptors face_descriptors(DescriptorContext& context, const std::vector<int>& chosen) {
    FaceDescriptors descriptors(chosen.size());
    SharedPart held = SharedPart::none;
    for (const int row : in_order_of_work(chosen)) {
        const Descriptor& descriptor = descriptor_table()[at(row)];
        if (descriptor.shared != held) context.release();
        held = descriptor.shared;
        FaceDescriptor& made =
            descriptors[at(std::lower_bound(chosen.begin(), chosen.end(), row) - chosen.begin())];
        made.row = row;
        made.values = descriptor.values(context);
        context.end_step(descriptor.step);
    }
    context.release();
    return descriptors;
}

std::vector<std::string> descriptor_steps(const std::vector<int>& chosen) {
    std::vector<std::string> steps;
    const auto add = [&](const std::string& step) {
        if (!step.empty() && std::find(steps.begin(), steps.end(), step) == steps.end())
            steps.push_back(step);
    };
    for (const int row : in_order_of_work(chosen)) {
        add(step_of(descriptor_table()[at(row)].shared));
        add(descriptor_table()[at(row)].step);
    }
    return steps;
}

Eigen::VectorXd shown_values(const FaceDescriptor& descriptor) {
    if (const auto* numbers = std::get_if<Eigen::VectorXd>(&descriptor.values)) return *numbers;
    return descriptor_table()[at(descriptor.row)].shown(std::get<Eigen::MatrixXf>(descriptor.values));
}

}  // namespace coseg
