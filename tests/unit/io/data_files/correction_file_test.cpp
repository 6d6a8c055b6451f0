#include "io/data_files/correction_file.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "io/files/atomic_file.hpp"
#include "src/base/error.hpp"
#include "tests/support/errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

TEST(CorrectionFile, HasEveryKindOfActAgainAsItWasWritten) {
    const char* acts[] = {
        R"({"act":"label","part":2,"shape":"a \"b\" ü","faces":"0-11,15","patches":"3"})",
        R"({"act":"confirm","shape":"a","labels":"0*12,3,0*2"})",
        R"({"act":"merge","part":3,"into":1})",
        R"({"act":"split","part":0})",
        R"({"act":"new-part"})",
        R"({"act":"name","part":0,"name":"left leg"})",
        R"({"act":"color","part":0,"color":"#0a1B2c"})",
        R"({"act":"absent","part":1,"shape":"b"})",
        R"({"act":"must-link","first":{"shape":"a","face":3},"second":{"shape":"b","patch":0}})",
        R"({"act":"cannot-link","first":{"shape":"a","patch":3},"second":{"shape":"a","patch":4}})",
        R"({"act":"level","parts":5})"};
    const test::TemporaryFolder folder;
    CorrectionFile file{"0123", {}, {}};
    for (const char* act : acts) {
        EXPECT_EQ(correction_text(parsed_correction(act, "here")), act);
        file.acts.push_back(parsed_correction(act, "here"));
    }
    file.undone.push_back(file.acts[2]);
    const std::string path = folder.path() + "/corrections.json";
    write_corrections(path, file);
    const CorrectionFile again = read_corrections(path);
    EXPECT_EQ(again.run, "0123");
    ASSERT_EQ(again.acts.size(), file.acts.size());
    for (std::size_t k = 0; k < file.acts.size(); ++k) {
        EXPECT_EQ(correction_text(again.acts[k]), acts[k]);
        EXPECT_EQ(again.acts[k].where, path + ", act " + std::to_string(k + 1));
    }
    ASSERT_EQ(again.undone.size(), 1U);
    EXPECT_EQ(correction_text(again.undone[0]), acts[2]);
}

TEST(CorrectionFile, WritesNumbersAsRangesAndLabelsAsRuns) {
    const std::vector<NumberRange> ranges = {{0, 2}, {7, 7}, {9, 10}};
    EXPECT_EQ(number_ranges(ranges), "0-2,7,9-10");
    EXPECT_EQ(parsed_ranges("0-2,7,9-10", 10), ranges);
    EXPECT_EQ(parsed_ranges("0,1-2,7,9,10", 10), ranges);
    const std::vector<LabelRun> runs = {{4, 2}, {0, 1}, {4, 1}};
    EXPECT_EQ(label_runs(runs), "4*2,0,4");
    EXPECT_EQ(parsed_runs("4*2,0,4"), runs);
    for (const char* bad : {"", "3-1", "1,1", "2,1", "-1", "x", "1-", "11", "1 2", "0-99999999999"})
        EXPECT_THROW(parsed_ranges(bad, 10), Error) << bad;
    for (const char* bad : {"", "1*0", "1*", "*2", "-1", "0*300000000", "0*-2", "1000"})
        EXPECT_THROW(parsed_runs(bad), Error) << bad;
}

TEST(CorrectionFile, KeepsTheBytesOfNamesThatAreNotUtf8) {
    Correction said;
    said.kind = CorrectionKind::absent;
    said.part = 1;
    said.shape = "caf\xe9";
    EXPECT_EQ(parsed_correction(correction_text(said), "here").shape, said.shape);
    said = {};
    said.kind = CorrectionKind::must_link;
    said.first = {"caf\xe9", 3, -1};
    said.second = {"b", 4, -1};
    EXPECT_EQ(parsed_correction(correction_text(said), "here").first, said.first);
}

TEST(CorrectionFile, RefusesWhatNoActCanBe) {
    for (const char* bad :
         {"[]", "{}", "3", R"({"act": 3})", R"({"act": "label", "part": 1, "shape": "a"})",
          R"({"act": "label", "part": -1, "shape": "a", "faces": "0"})",
          R"({"act": "label", "part": 1e9, "shape": "a", "faces": "0"})",
          R"({"act": "label", "part": 1, "shape": "a", "faces": [0]})",
          R"({"act": "merge", "part": 1, "into": 1})", R"({"act": "level", "parts": 1})",
          R"({"act": "name", "part": 0, "name": ""})", R"({"act": "color", "part": 0, "color": "red"})",
          R"({"act": "must-link", "first": {"shape": "a", "face": 1}})",
          R"({"act": "must-link", "first": {"shape": "a"}, "second": {"shape": "b", "face": 1}})"})
        EXPECT_THROW(parsed_correction(bad, "here"), Error) << bad;
    // A file of brackets without end must not end the process.
    EXPECT_THROW(parsed_correction(std::string(200'000, '['), "here"), Error);
}

TEST(CorrectionFile, ReadsTheSameConstraintsFromCsvAndFromJson) {
    const test::TemporaryFolder folder;
    const std::string csv = folder.path() + "/c.csv";
    const std::string json = folder.path() + "/c.json";
    write_file(csv, "# a comment\r\n\r\nmust-link, a, 3, b, 4\r\nabsent,1,b\nname,0,left leg\n");
    write_file(json, R"({"format": "coseg constraints", "version": 1, "constraints": [
        {"act": "must-link", "first": {"shape": "a", "face": 3}, "second": {"shape": "b", "face": 4}},
        {"act": "absent", "part": 1, "shape": "b"}, {"act": "name", "part": 0, "name": "left leg"}]})");
    const std::vector<Correction> from_csv = read_constraints(csv);
    const std::vector<Correction> from_json = read_constraints(json);
    ASSERT_EQ(from_csv.size(), 3U);
    ASSERT_EQ(from_json.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(correction_text(from_csv[k]), correction_text(from_json[k]));
    EXPECT_EQ(from_csv[1].where, csv + ":4");
    write_file(csv, "\xEF\xBB\xBFmust-link,a,3,b,4\r\n");  // as spreadsheets save it
    EXPECT_EQ(correction_text(read_constraints(csv).at(0)), correction_text(from_json[0]));
    write_file(csv, std::string("\0\0 must-link,a,3,b,4\n", 22));
    const std::string says = test::error_of([&] { read_constraints(csv); }).sentence;
    EXPECT_NE(says.find("is none of must-link"), std::string::npos) << says;
    write_file(
        json,
        R"({"format": "coseg constraints", "version": 1, "constraints": [{"act": "split", "part": 1}]})");
    EXPECT_THROW(read_constraints(json), Error);
}

TEST(CorrectionFile, CellsOfCsvMayStandInQuotes) {
    const test::TemporaryFolder folder;
    const auto read = [&](const std::string& row) {
        return read_constraints(folder.file("c.csv", row)).at(0);
    };
    const Correction link = read("must-link,\"a,b\",3, \"q\"\"uo,te\" ,4\r\n");
    EXPECT_EQ(link.first.shape, "a,b");
    EXPECT_EQ(link.second.shape, "q\"uo,te");
    EXPECT_EQ(link.second.face, 4);
    EXPECT_EQ(read("\"absent\",\"1\",\"\"\"b\"\"\"").shape, "\"b\"");
    EXPECT_EQ(read("name,0,5\" pipe").text, "5\" pipe");
    EXPECT_EQ(read("absent,1,\" b \"").shape, " b ");
    for (const auto& [row, words] :
         {std::pair("absent,1,\"b", "does not end with one"), std::pair("absent,1,\"b\"c", "'c' follows"),
          std::pair("absent,1,\"b\",", "such a row is absent,PART,SHAPE")}) {
        const std::string says = test::error_of([&, text = row] { read(text); }).sentence;
        EXPECT_NE(says.find(words), std::string::npos) << says;
        EXPECT_NE(says.find("c.csv:1:"), std::string::npos) << says;
    }
}

TEST(CorrectionFile, TextThatIsCutOffIsNotRepeatedWhole) {
    const test::TemporaryFolder folder;
    const std::string path =
        folder.file("c.json", "{\"format\": \"coseg corrections\",\n\"run\": \"" + std::string(5000, 'x'));
    const std::string says = test::error_of([&] { read_corrections(path); }).sentence;
    EXPECT_NE(says.find("line 2, column"), std::string::npos) << says;
    EXPECT_LT(says.size(), path.size() + 300);
}

}  // namespace
}  // namespace coseg
