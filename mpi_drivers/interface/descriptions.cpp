// coseg::describe.

#include <coseg/coseg.hpp>
#include <tuple>
#include <utility>

#include "mpi_drivers/describe/mesh_description.hpp"
#include "mpi_drivers/finished_runs/shown_descriptors.hpp"
#include "mpi_drivers/interface/collection_shapes.hpp"
#include "mpi_drivers/interface/library_call.hpp"
#include "mpi_drivers/options/named_options.hpp"
#include "src/base/index.hpp"
#include "src/mesh/polygon_area.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

struct ToldValues {
    std::string name;
    int dimensions = 0;
    std::vector<double> values;
    static constexpr auto fields() {
        return std::tuple(field("name", &ToldValues::name), field("dimensions", &ToldValues::dimensions),
                          field("values", &ToldValues::values));
    }
};

struct ToldDescription {
    int entry = 0;
    std::vector<double> areas;
    std::vector<ToldValues> descriptors;
    static constexpr auto fields() {
        return std::tuple(field("entry", &ToldDescription::entry), field("areas", &ToldDescription::areas),
                          field("descriptors", &ToldDescription::descriptors));
    }
};

/// d numbers a face of the input, face by face.
ToldValues told_values(const FaceDescriptor& descriptor, const MeshDescription& mesh) {
    Eigen::MatrixXd rows;
    if (const auto* numbers = std::get_if<Eigen::VectorXd>(&descriptor.values))
        rows = numbers->transpose();
    else
        rows = std::get<Eigen::MatrixXf>(descriptor.values).cast<double>();
    const auto dimensions = at(rows.rows());
    ToldValues told{descriptor_table()[at(descriptor.row)].name, static_cast<int>(rows.rows()), {}};
    told.values.resize(dimensions * at(mesh.map.input_faces));
    for (std::size_t d = 0; d < dimensions; ++d) {
        const std::vector<double> means =
            per_input_face(mesh.map, rows.row(static_cast<Eigen::Index>(d)).transpose(), mesh.geometry.area);
        for (std::size_t f = 0; f < means.size(); ++f) told.values[f * dimensions + d] = means[f];
    }
    return told;
}

ToldDescription described(int number, const MeshEntry& entry, const DescriptionOptions& options) {
    const auto [mesh, descriptors] = describe_mesh_faces(number, entry, options);
    ToldDescription told{number, polygon_areas(mesh.input), {}};
    for (const FaceDescriptor& descriptor : descriptors)
        told.descriptors.push_back(told_values(descriptor, mesh));
    return told;
}

/// Those that count, which are fewer than those that a run keeps in its state.
std::vector<int> weighted_rows(const std::vector<double>& weights) {
    std::vector<int> rows;
    for (std::size_t row = 0; row < weights.size(); ++row) {
        if (weights[row] > 0.0) rows.push_back(static_cast<int>(row));
    }
    return rows;
}

std::vector<ShapeDescription> all_described(LibraryCall& library, std::span<const Shape> given,
                                            const std::vector<Option>& named) {
    const Comm& comm = library.comm();
    ContentHasher hasher;
    add_options(hasher, named);
    refuse_differences(comm, hasher.result(), "options");
    DescriptionOptions options;
    agree(comm, [&] {
        const RunOptions run = options_by_name(named);
        options = run.description;
        options.descriptors = weighted_rows(run.features.weights);
    });
    const CollectionShapes shapes(comm, given);
    const auto count = static_cast<std::int64_t>(shapes.entries().size());
    std::vector<ToldDescription> local;
    library.log().begin("describe");
    agree(comm, [&] {
        for (std::int64_t k = comm.rank(); k < count; k += comm.size()) {
            library.log().progress(k, count);
            local.push_back(described(static_cast<int>(k), shapes.entries()[at(k)], options));
        }
    });
    library.log().end("");
    std::vector<ShapeDescription> result(at(count));
    for (ToldDescription& told : all_gather_records(comm, local)) {
        ShapeDescription& shape = result[shapes.index_of(at(told.entry))];
        shape.name = shapes.entries()[at(told.entry)].name;
        shape.areas = std::move(told.areas);
        for (ToldValues& values : told.descriptors)
            shape.descriptors.push_back(
                {std::move(values.name), values.dimensions, std::move(values.values)});
    }
    return result;
}

}  // namespace

std::vector<ShapeDescription> interface_1::describe(std::span<const Shape> shapes,
                                                    const std::vector<Option>& options, const Call& call) {
    return in_call(call, [&](LibraryCall& library) { return all_described(library, shapes, options); });
}

}  // namespace coseg
