#pragma once
// What a person says of a segmentation, one act at a time.

#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "src/base/enum_names.hpp"
#include "src/records/fields.hpp"
#include "src/records/number_runs.hpp"

namespace coseg {

enum class CorrectionKind {
    label,        ///< faces or patches of a shape have a part
    confirm,      ///< all faces of a shape have these labels, and the person has seen them
    merge,        ///< a part becomes one with another
    split,        ///< a part is divided as the tree of levels divides it
    new_part,     ///< there is one part more, of which nothing is known yet
    name,         ///< a part is called so
    color,        ///< a part is shown in this colour
    absent,       ///< a shape has nothing of a part
    must_link,    ///< two places have the same part
    cannot_link,  ///< two places have different parts
    level,        ///< all that follows is about this level of the tree
};
constexpr std::array<EnumName<CorrectionKind>, 11> enum_names(CorrectionKind /*type*/) {
    return {{{CorrectionKind::label, "label"},
             {CorrectionKind::confirm, "confirm"},
             {CorrectionKind::merge, "merge"},
             {CorrectionKind::split, "split"},
             {CorrectionKind::new_part, "new-part"},
             {CorrectionKind::name, "name"},
             {CorrectionKind::color, "color"},
             {CorrectionKind::absent, "absent"},
             {CorrectionKind::must_link, "must-link"},
             {CorrectionKind::cannot_link, "cannot-link"},
             {CorrectionKind::level, "level"}}};
}

/// A face of a shape, or a patch of its first over-segmentation, as patches/NAME.seg numbers them.
struct CorrectedPlace {
    std::string shape;
    int face = -1;   ///< -1 where it is a patch
    int patch = -1;  ///< -1 where it is a face
    friend bool operator==(const CorrectedPlace&, const CorrectedPlace&) = default;
    static constexpr auto fields() {
        return std::tuple(field("shape", &CorrectedPlace::shape), field("face", &CorrectedPlace::face),
                          field("patch", &CorrectedPlace::patch));
    }
};

/// One act. The members that its kind does not name keep their defaults.
struct Correction {
    CorrectionKind kind = CorrectionKind::label;
    /// label, merge, split, name, color, absent: the part. level: how many parts.
    int part = -1;
    int into = -1;                     ///< merge: the part that both become
    std::string shape;                 ///< label, confirm, absent
    std::vector<NumberRange> faces;    ///< label: of the file, ascending
    std::vector<NumberRange> patches;  ///< label: as in CorrectedPlace, ascending
    std::vector<LabelRun> labels;      ///< confirm: one for each face of the file
    std::string text;                  ///< name: the name; color: #rrggbb
    CorrectedPlace first;              ///< must_link, cannot_link
    CorrectedPlace second;             ///< likewise
    std::string where;                 ///< where it stands, for messages: "corrections.json, act 3"
    static constexpr auto fields() {
        return std::tuple(field("kind", &Correction::kind), field("part", &Correction::part),
                          field("into", &Correction::into), field("shape", &Correction::shape),
                          field("faces", &Correction::faces), field("patches", &Correction::patches),
                          field("labels", &Correction::labels), field("text", &Correction::text),
                          field("first", &Correction::first), field("second", &Correction::second),
                          field("where", &Correction::where));
    }
};

}  // namespace coseg
