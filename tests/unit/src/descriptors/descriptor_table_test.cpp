#include "src/descriptors/descriptor_table.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "src/base/index.hpp"
#include "src/mesh/dual_graph.hpp"
#include "tests/support/shapes.hpp"

namespace coseg {
namespace {

std::vector<int> all_rows() {
    std::vector<int> rows(descriptor_table().size());
    std::iota(rows.begin(), rows.end(), 0);
    return rows;
}

struct Described {
    FaceDescriptors descriptors;
    std::vector<std::string> steps;
};

Described described(const std::vector<int>& rows) {
    TriMesh mesh = test::sphere(2);
    scale_to_unit_area(mesh);
    const FaceGeometry geometry = face_geometry(mesh);
    const DualGraph graph = dual_graph(mesh, geometry);
    Described result;
    DescriptorContext context(mesh, geometry, graph, 20, 1,
                              [&](const char* step) { result.steps.emplace_back(step); });
    result.descriptors = face_descriptors(context, rows);
    return result;
}

TEST(DescriptorTable, HasRowsThatAreFitToBeUsed) {
    std::set<std::string> names;
    for (const Descriptor& row : descriptor_table()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_FALSE(row.phrase.empty()) << row.name;
        EXPECT_GE(row.weight, 0.0) << row.name;
        ASSERT_NE(row.values, nullptr) << row.name;
        EXPECT_EQ(row.shown != nullptr, row.bins == BinKind::words) << row.name;
    }
    EXPECT_EQ(descriptor_names().size(), descriptor_table().size());
    EXPECT_EQ(default_descriptor_weights().size(), descriptor_table().size());
    EXPECT_EQ(equal_descriptor_weights().size(), descriptor_table().size());
}

TEST(DescriptorTable, GivesEachFaceFiniteValuesOfTheKindOfTheRow) {
    const Described all = described(all_rows());
    ASSERT_EQ(all.descriptors.size(), descriptor_table().size());
    for (const FaceDescriptor& one : all.descriptors) {
        const Descriptor& row = descriptor_table()[at(one.row)];
        EXPECT_EQ(std::holds_alternative<Eigen::MatrixXf>(one.values), row.bins == BinKind::words)
            << row.name;
        const Eigen::VectorXd shown = shown_values(one);
        EXPECT_EQ(shown.size(), 320) << row.name;
        EXPECT_TRUE(shown.allFinite()) << row.name;
    }
}

TEST(DescriptorTable, GivesTheSameValuesAloneAsTogether) {
    const Described all = described(all_rows());
    for (const int row : all_rows()) {
        const Described alone = described({row});
        ASSERT_EQ(alone.descriptors.size(), 1U);
        EXPECT_EQ(alone.descriptors.front().row, row);
        EXPECT_EQ(alone.descriptors.front().values, all.descriptors[at(row)].values)
            << descriptor_table()[at(row)].name;
    }
}

TEST(DescriptorTable, NamesTheStepsThatItTakes) {
    for (const std::vector<int>& rows : {all_rows(), std::vector<int>{1, 3}, std::vector<int>{}}) {
        const std::vector<std::string> expected = descriptor_steps(rows);
        std::vector<std::string> found;
        for (const std::string& step : described(rows).steps) {
            if (found.empty() || found.back() != step) found.push_back(step);
        }
        EXPECT_EQ(found, expected);  // so no step comes back after another one
    }
    EXPECT_EQ(descriptor_steps({2, 3}), (std::vector<std::string>{"geodesics", "contexts"}));
}

}  // namespace
}  // namespace coseg
