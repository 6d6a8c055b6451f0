#include "io/data_files/alignment_file.hpp"

#include <nlohmann/json.hpp>

#include "io/files/file_contents.hpp"
#include "io/files/json_failure.hpp"
#include "src/base/error.hpp"
#include "src/base/text.hpp"

namespace coseg {

namespace {

using Json = nlohmann::ordered_json;
constexpr const char* alignment_format = "coseg alignment 1";

Json json_of(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json json_of(const AlignedShape& shape) {
    Json json;
    json["name"] = shape.name;
    if (const auto bytes = hex_unless_utf8(shape.name)) json["name_bytes"] = *bytes;
    json["rotation"] = Json::array();
    for (int row = 0; row < 3; ++row)
        json["rotation"].push_back(json_of(shape.rotation.row(row).transpose()));
    json["scale"] = shape.scale;
    json["translation"] = json_of(shape.translation);
    json["agreement"] = shape.agreement;
    json["residual"] = shape.residual;
    json["reflected"] = shape.reflected;
    json["found"] = shape.found;
    return json;
}

Eigen::Vector3d vector_of(const Json& json) {
    return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

AlignedShape shape_of(const Json& json, const std::string& path) {
    AlignedShape shape;
    shape.name = json.contains("name_bytes") ? bytes_of_hex(json.at("name_bytes").get<std::string>())
                                             : json.at("name").get<std::string>();
    for (int row = 0; row < 3; ++row)
        shape.rotation.row(row) =
            vector_of(json.at("rotation").at(static_cast<std::size_t>(row))).transpose();
    if (!(shape.rotation * shape.rotation.transpose()).isIdentity(1e-6))
        throw Error(ExitCode::input, path + ": the rotation of '" + shape.name + "' is none");
    shape.scale = json.at("scale").get<double>();
    shape.translation = vector_of(json.at("translation"));
    shape.agreement = json.at("agreement").get<double>();
    shape.residual = json.at("residual").get<double>();
    shape.reflected = json.at("reflected").get<bool>();
    shape.found = json.at("found").get<bool>();
    return shape;
}

AlignmentFile file_of(const Json& json, const std::string& path) {
    AlignmentFile file;
    file.aligned = json.at("aligned").get<bool>();
    file.reason = json.at("reason").get<std::string>();
    file.standing_share = json.at("standing_share").get<double>();
    file.agreement_before = json.at("agreement_before").get<double>();
    file.agreement_after = json.at("agreement_after").get<double>();
    for (const Json& shape : json.at("shapes")) file.shapes.push_back(shape_of(shape, path));
    return file;
}

}  // namespace

std::string alignment_text(const AlignmentFile& alignment) {
    Json json;
    json["format"] = alignment_format;
    json["aligned"] = alignment.aligned;
    json["reason"] = alignment.reason;
    json["standing_share"] = alignment.standing_share;
    json["agreement_before"] = alignment.agreement_before;
    json["agreement_after"] = alignment.agreement_after;
    json["shapes"] = Json::array();
    for (const AlignedShape& shape : alignment.shapes) json["shapes"].push_back(json_of(shape));
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

AlignmentFile read_alignment(const std::string& path) {
    try {
        const Json json = Json::parse(read_regular_file(path));
        if (json.at("format").get<std::string>() != alignment_format)
            throw Error(ExitCode::input, path + ": is not an alignment of this version of coseg");
        return file_of(json, path);
    } catch (const Json::exception& error) {
        throw Error(ExitCode::input, path + ": cannot be read as an alignment (" + json_failure(error) +
                                         "); run coseg run again");
    }
}

}  // namespace coseg
