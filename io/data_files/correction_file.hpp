#pragma once
// corrections.json: what a person has said of a run, act by act; and files of constraints alone.
// docs/editing.md describes both formats.

#include <string>
#include <string_view>
#include <vector>

#include "src/records/correction.hpp"

namespace coseg {

/// The content of corrections.json.
struct CorrectionFile {
    std::string run;                 ///< the hash of the run that the acts are about
    std::vector<Correction> acts;    ///< in their order
    std::vector<Correction> undone;  ///< taken back, the last one first; they may be done again
};

/// Throws Error(input) naming path and act where the file cannot be read, is no such file or of another
/// version, or an act lacks a member, has one of another kind or says what no shape can have.
CorrectionFile read_corrections(const std::string& path);

/// The file is there whole or not at all. Throws Error(output).
void write_corrections(const std::string& path, const CorrectionFile& corrections);

/// Constraints: must-link, cannot-link, absent and name, as JSON or as CSV. Throws as read_corrections.
std::vector<Correction> read_constraints(const std::string& path);

/// One act as JSON. `where` is what messages call it. Throws Error(input) as read_corrections.
Correction parsed_correction(std::string_view json, const std::string& where);
/// The same act as JSON, in one line.
std::string correction_text(const Correction& correction);

/// What an act says, in a few words: "label part 2 in vase_1".
std::string summary_of(const Correction& correction);

/// Ascending numbers as ranges: "0-11,15". The inverse throws Error(input) where a text is none, or has a
/// number above `most`.
std::string number_ranges(const std::vector<NumberRange>& ranges);
std::vector<NumberRange> parsed_ranges(std::string_view text, int most);

/// Labels as runs: "0*12,3,0*2". The inverse throws Error(input) where a text is none.
std::string label_runs(const std::vector<LabelRun>& runs);
std::vector<LabelRun> parsed_runs(std::string_view text);

}  // namespace coseg
