#include "io/reports/report.hpp"

#include "io/files/text_checksum.hpp"
#include "io/reports/record_json.hpp"

namespace coseg {

std::string report_text(const NamedTexts& versions, const NamedTexts& options, const Report& report) {
    JsonTree tree;
    const JsonPlace root = tree.root();
    root.member("format").set("coseg report 1");
    root.member(checksum_member).set(blank_checksum);
    for (const auto& [name, version] : versions) root.member("versions").member(name).set(version);
    for (const auto& [key, value] : options) root.member("options").member(key).set_typed(value);
    set_json_members(root, report);
    return with_checksum(tree.pretty() + "\n");
}

}  // namespace coseg
