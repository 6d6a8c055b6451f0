#include "io/gltf/gltf_compaction.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "io/files/byte_cursor.hpp"
#include "io/gltf/gltf_accessor.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

using CompactJson = nlohmann::ordered_json;

/// New numbers of the elements of a list, in the order in which they are first asked for.
class Renumbering {
  public:
    int operator()(int old) {
        const auto [found, is_new] = number_.try_emplace(old, static_cast<int>(kept_.size()));
        if (is_new) kept_.push_back(old);
        return found->second;
    }
    [[nodiscard]] const std::vector<int>& kept() const { return kept_; }

  private:
    std::map<int, int> number_;
    std::vector<int> kept_;
};

/// Those of the elements that are kept, as `change` makes them; the list may grow meanwhile.
template <class Change>
void keep_elements(CompactJson& json, const char* list, Renumbering& numbers, Change&& change) {
    const CompactJson old = json.value(list, CompactJson::array());
    CompactJson kept = CompactJson::array();
    for (std::size_t k = 0; k < numbers.kept().size(); ++k) {
        CompactJson element = old.at(at(numbers.kept()[k]));
        change(element);
        kept.push_back(std::move(element));
    }
    json.erase(list);
    if (!kept.empty()) json[list] = std::move(kept);
}

void renumber(CompactJson& object, const char* key, Renumbering& numbers) {
    if (object.contains(key)) object[key] = numbers(object[key].get<int>());
}

/// Members of `extensions` whose names do not begin so.
void erase_other_extensions(CompactJson& object, const std::vector<std::string_view>& begins) {
    if (!object.contains("extensions")) return;
    CompactJson kept = CompactJson::object();
    for (auto& [name, value] : object["extensions"].items()) {
        const bool is_kept = std::any_of(begins.begin(), begins.end(), [&key = name](std::string_view begin) {
            return key.starts_with(begin);
        });
        if (is_kept) kept[name] = value;
    }
    object.erase("extensions");
    if (!kept.empty()) object["extensions"] = std::move(kept);
}

constexpr const char* mesh_variants = "KHR_materials_variants";

/// The vertices that primitives with the same attributes use, ascending.
struct VertexUse {
    std::set<std::uint32_t> vertices;
    bool can_be_taken_apart = true;
    std::map<int, int> attribute;  ///< accessor -> its new number
};

class GltfCompaction {
  public:
    GltfCompaction(std::string_view glb, const std::string& path)
        : path_(path),
          container_(split_gltf(glb, path)),
          asset_(read_gltf_asset(container_, path)),
          json_(CompactJson::parse(container_.json)) {
        // Limits of an accessor are those of its numbers as they are kept.
        for (GltfAccessor& accessor : asset_.accessors) accessor.is_normalized = false;
        old_accessors_ = json_.value("accessors", CompactJson::array());
        old_views_ = json_.value("bufferViews", CompactJson::array());
        for (const char* list : {"accessors", "bufferViews"}) json_[list] = CompactJson::array();
    }

    std::string run() {
        keep_scene();
        keep_nodes();
        keep_skins_and_animations();
        renumber_nodes();
        keep_meshes();
        keep_materials();
        keep_images();
        erase_other_extensions(json_, {"KHR_materials_", "KHR_lights_", "EXT_lights_"});
        json_.erase("cameras");
        for (const char* list : {"accessors", "bufferViews"}) {
            if (json_[list].empty()) json_.erase(list);
        }
        json_["buffers"][0]["byteLength"] = binary_.size();
        return glb_of(json_.dump(-1, ' ', false, CompactJson::error_handler_t::replace), binary_, path_);
    }

  private:
    void keep_scene() {
        const CompactJson scene = json_["scenes"][at(asset_.scene)];
        json_["scenes"] = CompactJson::array({scene});
        json_["scene"] = 0;
    }

    void keep_node(int node) {
        std::vector<int> open{node};
        while (!open.empty()) {
            const int next = open.back();
            open.pop_back();
            json_.at("nodes").at(
                at(next));  // throws for joints that are not there: no one has looked at these
            if (!reached_.insert(next).second) continue;
            const GltfNode& record = asset_.nodes[at(next)];
            open.insert(open.end(), record.children.begin(), record.children.end());
            if (record.mesh >= 0 && record.skin >= 0) skins_(record.skin);
        }
    }

    void keep_nodes() {
        for (const int root : asset_.roots) keep_node(root);
        for (std::size_t k = 0; k < skins_.kept().size(); ++k) {
            const CompactJson& skin = json_["skins"][at(skins_.kept()[k])];
            for (const CompactJson& joint : skin.at("joints")) keep_node(joint.get<int>());
            if (skin.contains("skeleton")) keep_node(skin["skeleton"].get<int>());
        }
        for (const int node : reached_) nodes_(node);
    }

    void keep_skins_and_animations() {
        keep_elements(json_, "skins", skins_, [&](CompactJson& skin) {
            for (CompactJson& joint : skin["joints"]) joint = nodes_(joint.get<int>());
            renumber(skin, "skeleton", nodes_);
            if (skin.contains("inverseBindMatrices"))
                skin["inverseBindMatrices"] = whole_accessor(skin["inverseBindMatrices"].get<int>());
        });
        if (!json_.contains("skins")) json_.erase("animations");
        if (!json_.contains("animations")) return;
        for (CompactJson& animation : json_["animations"]) {
            for (CompactJson& sampler : animation["samplers"]) {
                for (const char* end : {"input", "output"})
                    sampler[end] = whole_accessor(sampler[end].get<int>());
            }
            CompactJson channels = CompactJson::array();
            for (CompactJson& channel : animation["channels"]) {
                CompactJson& target = channel["target"];
                if (target.contains("node") && !reached_.contains(target["node"].get<int>())) continue;
                renumber(target, "node", nodes_);
                channels.push_back(channel);
            }
            animation["channels"] = std::move(channels);
        }
    }

    void renumber_nodes() {
        keep_elements(json_, "nodes", nodes_, [&](CompactJson& node) {
            if (node.contains("children")) {
                for (CompactJson& child : node["children"]) child = nodes_(child.get<int>());
            }
            renumber(node, "mesh", meshes_);
            renumber(node, "skin", skins_);
            node.erase("camera");
            erase_other_extensions(node, {"KHR_lights_"});
        });
        for (CompactJson& node : json_["scenes"][0]["nodes"]) node = nodes_(node.get<int>());
    }

    // ---- Meshes ----

    static std::vector<int> vertex_accessors(const CompactJson& primitive) {
        std::vector<int> accessors;
        const auto add = [&](const CompactJson& attributes) {
            for (const auto& [name, accessor] : attributes.items()) accessors.push_back(accessor.get<int>());
        };
        if (primitive.contains("attributes")) add(primitive["attributes"]);
        for (const CompactJson& target : primitive.value("targets", CompactJson::array())) add(target);
        return accessors;
    }

    /// Primitives without indices stay whole.
    void note_vertices(const CompactJson& primitive) {
        const std::vector<int> accessors = vertex_accessors(primitive);
        VertexUse& use = uses_[accessors];
        std::size_t count = std::numeric_limits<std::size_t>::max();
        for (const int number : accessors) {
            old_accessors_.at(at(number));  // throws if it is not there
            const GltfAccessor& accessor = asset_.accessors[at(number)];
            if (!has_elements(accessor) || accessor.components == 0) use.can_be_taken_apart = false;
            count = std::min(count, accessor.count);
        }
        if (!primitive.contains("indices")) use.can_be_taken_apart = false;
        if (!use.can_be_taken_apart) return;
        const GltfElements indices(asset_, primitive["indices"].get<int>());
        for (std::size_t k = 0; k < indices.count(); ++k) use.vertices.insert(indices.index(k));
        if (!use.vertices.empty() && *use.vertices.rbegin() >= count) use.can_be_taken_apart = false;
    }

    void keep_meshes() {
        for (const int mesh : meshes_.kept()) {
            for (const CompactJson& primitive : json_["meshes"][at(mesh)]["primitives"])
                note_vertices(primitive);
        }
        keep_elements(json_, "meshes", meshes_, [&](CompactJson& mesh) {
            erase_other_extensions(mesh, {});
            for (CompactJson& primitive : mesh["primitives"]) compact_primitive(primitive);
        });
    }

    void compact_primitive(CompactJson& primitive) {
        VertexUse& use = uses_[vertex_accessors(primitive)];
        if (primitive.contains("indices")) {
            const int indices = primitive["indices"].get<int>();
            primitive["indices"] =
                use.can_be_taken_apart ? indices_of(indices, use) : whole_accessor(indices);
        }
        const auto change = [&](CompactJson& attributes) {
            for (auto& [name, accessor] : attributes.items())
                accessor = attribute_of(accessor.get<int>(), use);
        };
        if (primitive.contains("attributes")) change(primitive["attributes"]);
        if (primitive.contains("targets")) {
            for (CompactJson& target : primitive["targets"]) change(target);
        }
        renumber(primitive, "material", materials_);
        erase_other_extensions(primitive, {mesh_variants});
        if (!primitive.contains("extensions")) return;
        for (CompactJson& mapping : primitive["extensions"][mesh_variants]["mappings"])
            renumber(mapping, "material", materials_);
    }

    int append(const char* list, CompactJson value) {
        json_[list].push_back(std::move(value));
        return static_cast<int>(json_[list].size()) - 1;
    }

    std::size_t append_bytes(std::string_view bytes) {
        binary_.append((4 - binary_.size() % 4) % 4, '\0');
        const std::size_t offset = binary_.size();
        binary_.append(bytes);
        return offset;
    }

    int add_view(CompactJson view, std::string_view bytes) {
        view["buffer"] = 0;
        view["byteOffset"] = append_bytes(bytes);
        view["byteLength"] = bytes.size();
        return append("bufferViews", std::move(view));
    }

    int whole_view(int number) {
        const auto [found, is_new] = views_.try_emplace(number, -1);
        if (is_new) {
            CompactJson old = old_views_.at(at(number));
            const GltfView& view = asset_.views[at(number)];
            found->second =
                add_view(std::move(old), asset_.buffers[at(view.buffer)].substr(view.offset, view.length));
        }
        return found->second;
    }

    int whole_accessor(int number) {
        const auto [found, is_new] = accessors_.try_emplace(number, -1);
        if (!is_new) return found->second;
        CompactJson accessor = old_accessors_.at(at(number));
        if (accessor.contains("bufferView"))
            accessor["bufferView"] = whole_view(accessor["bufferView"].get<int>());
        if (accessor.contains("sparse")) {
            for (const char* end : {"indices", "values"}) {
                CompactJson& view = accessor["sparse"][end]["bufferView"];
                view = whole_view(view.get<int>());
            }
        }
        return found->second = append("accessors", std::move(accessor));
    }

    int indices_of(int number, const VertexUse& use) {
        const GltfElements indices(asset_, number);
        const bool is_short = use.vertices.size() < std::numeric_limits<std::uint16_t>::max();
        std::map<std::uint32_t, std::uint32_t> numbers;
        for (const std::uint32_t vertex : use.vertices)
            numbers.emplace_hint(numbers.end(), vertex, static_cast<std::uint32_t>(numbers.size()));
        std::string bytes;
        for (std::size_t k = 0; k < indices.count(); ++k) {
            const std::uint32_t index = numbers.at(indices.index(k));
            if (is_short)
                append_little_endian(bytes, static_cast<std::uint16_t>(index));
            else
                append_little_endian(bytes, index);
        }
        CompactJson accessor = old_accessors_.at(at(number));
        for (const char* old : {"byteOffset", "sparse", "min", "max"}) accessor.erase(old);
        accessor["componentType"] = is_short ? 5123 : 5125;
        accessor["bufferView"] = add_view({{"target", 34963}}, bytes);
        return append("accessors", std::move(accessor));
    }

    int attribute_of(int number, VertexUse& use) {
        if (!use.can_be_taken_apart) return whole_accessor(number);
        const auto [found, is_new] = use.attribute.try_emplace(number, -1);
        if (!is_new) return found->second;
        const GltfElements elements(asset_, number);
        std::string bytes;
        std::size_t size = 0;
        for (const std::uint32_t vertex : use.vertices) {
            const std::string_view element = elements.bytes(vertex);
            bytes.append(element);
            size = element.size();
            bytes.append((4 - size % 4) % 4, '\0');
        }
        CompactJson view{{"target", 34962}};
        if (size % 4 != 0) view["byteStride"] = size + 4 - size % 4;
        CompactJson accessor = old_accessors_.at(at(number));
        for (const char* old : {"byteOffset", "sparse"}) accessor.erase(old);
        accessor["bufferView"] = add_view(std::move(view), bytes);
        accessor["count"] = use.vertices.size();
        if (accessor.contains("min") || accessor.contains("max")) set_limits(accessor, elements, use);
        return found->second = append("accessors", std::move(accessor));
    }

    static void set_limits(CompactJson& accessor, const GltfElements& elements, const VertexUse& use) {
        CompactJson low = CompactJson::array();
        CompactJson high = CompactJson::array();
        for (int c = 0; c < elements.components(); ++c) {
            double least = std::numeric_limits<double>::max();
            double most = -least;
            for (const std::uint32_t vertex : use.vertices) {
                least = std::min(least, elements.real(vertex, c));
                most = std::max(most, elements.real(vertex, c));
            }
            low.push_back(least);
            high.push_back(most);
        }
        accessor["min"] = std::move(low);
        accessor["max"] = std::move(high);
    }

    // ---- Looks ----

    /// Textures are what members called "...Texture" name, also in extensions of materials.
    void renumber_textures(CompactJson& value) {
        if (!value.is_object()) return;
        for (auto& [key, member] : value.items()) {
            const bool is_texture =
                key.ends_with("Texture") && member.is_object() && member.contains("index");
            if (is_texture) renumber(member, "index", textures_);
            if (key != "extras") renumber_textures(member);
        }
    }

    void keep_materials() {
        keep_elements(json_, "materials", materials_,
                      [&](CompactJson& material) { renumber_textures(material); });
        keep_elements(json_, "textures", textures_, [&](CompactJson& texture) {
            renumber(texture, "source", images_);
            if (!texture.contains("extensions")) return;
            for (auto& [name, extension] : texture["extensions"].items())
                renumber(extension, "source", images_);
        });
    }

    void keep_images() {
        keep_elements(json_, "images", images_, [&](CompactJson& image) {
            if (image.contains("bufferView"))
                image["bufferView"] = whole_view(image["bufferView"].get<int>());
        });
    }

    std::string path_;
    GltfContainer container_;
    GltfAsset asset_;
    CompactJson json_;
    CompactJson old_accessors_;
    CompactJson old_views_;
    std::string binary_;
    std::set<int> reached_;
    Renumbering nodes_, skins_, meshes_, materials_, textures_, images_;
    std::map<std::vector<int>, VertexUse> uses_;  ///< by the accessors of attributes and targets
    std::map<int, int> accessors_;                ///< that stay whole: old number -> new number
    std::map<int, int> views_;
};

}  // namespace

std::string compact_glb(std::string_view glb, const std::string& path) {
    return GltfCompaction(glb, path).run();
}

}  // namespace coseg
