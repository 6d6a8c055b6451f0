#include "io/gltf/gltf_compaction.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/gltf/gltf_accessor.hpp"
#include "io/gltf/gltf_asset.hpp"
#include "io/gltf/gltf_container.hpp"
#include "tests/support/gltf_files.hpp"

namespace coseg {
namespace {

/// Two meshes of the same six vertices, each moved by a skin of its own. The scene draws the second one,
/// whose triangle is 5, 2, 4. An animation turns a joint of either skin.
const std::string skinned_json =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[1]}],"nodes":[)"
    R"({"name":"left out","mesh":0,"skin":0},{"name":"drawn","mesh":1,"skin":1},{"name":"other joint"},)"
    R"({"name":"hip","children":[4]},{"name":"knee","translation":[0,-1,0]}],)"
    R"("skins":[{"joints":[2],"inverseBindMatrices":4},)"
    R"({"name":"leg","joints":[4,3],"skeleton":3,"inverseBindMatrices":5}],)"
    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":3}]},{"primitives":[)"
    R"({"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":3}]}],)"
    R"("animations":[{"channels":[{"sampler":0,"target":{"node":2,"path":"rotation"}},)"
    R"({"sampler":0,"target":{"node":4,"path":"rotation"}}],"samplers":[{"input":6,"output":7}]}],)"
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3","min":[0,0,0],"max":[5,50,5]},)"
    R"({"bufferView":1,"componentType":5121,"count":6,"type":"VEC4"},)"
    R"({"bufferView":2,"componentType":5126,"count":6,"type":"VEC4"},)"
    R"({"bufferView":3,"componentType":5123,"count":3,"type":"SCALAR"},)"
    R"({"bufferView":4,"componentType":5126,"count":1,"type":"MAT4"},)"
    R"({"bufferView":5,"componentType":5126,"count":2,"type":"MAT4"},)"
    R"({"bufferView":6,"componentType":5126,"count":2,"type":"SCALAR"},)"
    R"({"bufferView":7,"componentType":5126,"count":2,"type":"VEC4"}],"bufferViews":[)"
    R"({"buffer":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":24},)"
    R"({"buffer":0,"byteOffset":96,"byteLength":96},{"buffer":0,"byteOffset":192,"byteLength":6},)"
    R"({"buffer":0,"byteOffset":200,"byteLength":64},{"buffer":0,"byteOffset":264,"byteLength":128},)"
    R"({"buffer":0,"byteOffset":392,"byteLength":8},{"buffer":0,"byteOffset":400,"byteLength":32}],)"
    R"("buffers":[{"byteLength":432}]})";

/// `count` numbers from `first` on, in steps of a half.
std::string halves(int count, float first) {
    std::vector<float> values;
    for (int k = 0; k < count; ++k) values.push_back(first + 0.5F * static_cast<float>(k));
    return test::little_endian(values);
}

std::string skinned_bytes() {
    std::string bytes;
    for (int v = 0; v < 6; ++v) {
        const auto x = static_cast<float>(v);
        bytes += test::little_endian<float>({x, 10.0F * x, 5.0F - x});
    }
    for (int v = 0; v < 6; ++v)
        bytes += test::little_endian<std::uint8_t>({1, 0, static_cast<std::uint8_t>(v % 2), 0});
    bytes += halves(24, 100.0F);
    bytes += test::little_endian<std::uint16_t>({5, 2, 4, 0});
    return bytes + halves(16, 200.0F) + halves(32, 300.0F) + halves(2, 400.0F) + halves(8, 500.0F);
}

class CompactedSkin : public testing::Test {
  protected:
    [[nodiscard]] GltfElements elements(const nlohmann::json& number) const {
        return {asset_, number.get<int>()};
    }

    std::string file_ = compact_glb(glb_of(skinned_json, skinned_bytes(), "test.glb"), "test.glb");
    GltfContainer container_ = split_gltf(file_, "test.glb");
    GltfAsset asset_ = read_gltf_asset(container_, "test.glb");
    nlohmann::json json_ = nlohmann::json::parse(container_.json);
};

TEST_F(CompactedSkin, KeepsTheJointsOfTheSkinThatIsDrawn) {
    ASSERT_EQ(json_["nodes"].size(), 3U);
    EXPECT_EQ(json_["scenes"][0]["nodes"], nlohmann::json(std::vector<int>{0}));
    EXPECT_EQ(json_["nodes"][0], nlohmann::json({{"name", "drawn"}, {"mesh", 0}, {"skin", 0}}));
    EXPECT_EQ(json_["nodes"][1], nlohmann::json({{"name", "hip"}, {"children", {2}}}));
    EXPECT_EQ(json_["nodes"][2]["name"], "knee");
    EXPECT_EQ(json_["nodes"][2]["translation"], nlohmann::json({0, -1, 0}));
    ASSERT_EQ(json_["skins"].size(), 1U);
    EXPECT_EQ(json_["skins"][0]["name"], "leg");
    EXPECT_EQ(json_["skins"][0]["joints"], nlohmann::json({2, 1}));
    EXPECT_EQ(json_["skins"][0]["skeleton"], 1);
}

TEST_F(CompactedSkin, KeepsTheBytesOfMatricesJointsAndWeights) {
    const auto matrices = json_["skins"][0]["inverseBindMatrices"].get<std::size_t>();
    EXPECT_EQ(json_["accessors"][matrices]["count"], 2);
    const GltfView& view = asset_.views[json_["accessors"][matrices]["bufferView"].get<std::size_t>()];
    EXPECT_EQ(asset_.buffers[0].substr(view.offset, view.length), halves(32, 300.0F));
    ASSERT_EQ(json_["meshes"].size(), 1U);
    const nlohmann::json& primitive = json_["meshes"][0]["primitives"][0];
    const GltfElements indices = elements(primitive["indices"]);
    ASSERT_EQ(indices.count(), 3U);
    EXPECT_EQ((std::vector{indices.index(0), indices.index(1), indices.index(2)}),
              (std::vector<std::uint32_t>{2, 0, 1}));
    const std::vector<int> kept = {2, 4, 5};
    for (const char* attribute : {"POSITION", "JOINTS_0", "WEIGHTS_0"})
        ASSERT_EQ(elements(primitive["attributes"][attribute]).count(), kept.size()) << attribute;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        const auto x = static_cast<float>(kept[k]);
        EXPECT_EQ(elements(primitive["attributes"]["POSITION"]).bytes(k),
                  test::little_endian<float>({x, 10.0F * x, 5.0F - x}));
        EXPECT_EQ(elements(primitive["attributes"]["JOINTS_0"]).bytes(k),
                  test::little_endian<std::uint8_t>({1, 0, static_cast<std::uint8_t>(kept[k] % 2), 0}));
        EXPECT_EQ(elements(primitive["attributes"]["WEIGHTS_0"]).bytes(k), halves(4, 100.0F + 2.0F * x));
    }
    const nlohmann::json& positions =
        json_["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
    EXPECT_EQ(positions["min"], nlohmann::json({2.0, 20.0, 0.0}));
    EXPECT_EQ(positions["max"], nlohmann::json({5.0, 50.0, 3.0}));
}

TEST_F(CompactedSkin, KeepsOfAnAnimationWhatMovesAJointThatIsThere) {
    ASSERT_EQ(json_["animations"].size(), 1U);
    const nlohmann::json& animation = json_["animations"][0];
    ASSERT_EQ(animation["channels"].size(), 1U);
    EXPECT_EQ(animation["channels"][0]["target"], nlohmann::json({{"node", 2}, {"path", "rotation"}}));
    const GltfElements times = elements(animation["samplers"][0]["input"]);
    EXPECT_EQ(std::string(times.bytes(0)) + std::string(times.bytes(1)), halves(2, 400.0F));
    const GltfElements turns = elements(animation["samplers"][0]["output"]);
    EXPECT_EQ(std::string(turns.bytes(0)) + std::string(turns.bytes(1)), halves(8, 500.0F));
}

}  // namespace
}  // namespace coseg
