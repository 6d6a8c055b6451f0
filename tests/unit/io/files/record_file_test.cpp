#include "io/files/record_file.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/errors.hpp"
#include "tests/support/every_kind.hpp"
#include "tests/support/temporary_folder.hpp"

namespace coseg {
namespace {

using test::changed_records;
using test::EveryKind;
using test::filled_record;
using test::Nested;
using test::TemporaryFolder;

std::string written(const TemporaryFolder& folder, const std::string& path, const EveryKind& record) {
    const std::string name = folder.path() + "/record.h5";
    Hdf5Writer file(name, "coseg test", 1);
    write_record(file, path, record);
    file.commit();
    return name;
}

EveryKind read_back(const std::string& name, const std::string& path) {
    const Hdf5Reader file(name, "coseg test", 1);
    EveryKind record;
    read_record(file, path, record);
    return record;
}

TEST(RecordFile, ARecordWithEveryKindOfFieldComesBack) {
    const TemporaryFolder folder;
    for (const char* path : {"", "inner/record"}) {
        EXPECT_EQ(read_back(written(folder, path, filled_record(1)), path), filled_record(1));
        EXPECT_EQ(read_back(written(folder, path, EveryKind{}), path), EveryKind{});
    }
}

TEST(RecordFile, RowsOfRecordsComeBack) {
    const TemporaryFolder folder;
    for (const std::vector<EveryKind>& rows :
         {std::vector<EveryKind>{filled_record(1), EveryKind{}, filled_record(2)},
          std::vector<EveryKind>{}}) {
        const std::string name = folder.path() + "/rows.h5";
        Hdf5Writer writer(name, "coseg test", 1);
        write_column(writer, "rows", rows);
        writer.commit();
        EXPECT_EQ(read_column<EveryKind>(Hdf5Reader(name, "coseg test", 1), "rows"), rows);
    }
}

TEST(RecordFile, EveryFieldIsCarried) {
    const TemporaryFolder folder;
    for (const EveryKind& changed : changed_records())
        EXPECT_EQ(read_back(written(folder, "", changed), ""), changed);
}

TEST(RecordFile, AFileWithoutTheFieldsOfTheRecordIsRefused) {
    const TemporaryFolder folder;
    const std::string name = written(folder, "", filled_record(1));
    EXPECT_THROW(read_back(name, "elsewhere"), Error);
}

TEST(RecordFile, ColumnsOfDifferentLengthAreRefused) {
    const TemporaryFolder folder;
    const std::string name = folder.path() + "/torn.h5";
    Hdf5Writer writer(name, "coseg test", 1);
    writer.write_texts("rows/name", {"a", "b"});
    writer.write("rows/values/count", std::vector<std::int64_t>{1});
    writer.write("rows/values/value", std::vector<double>{1.0});
    writer.commit();
    EXPECT_THROW(read_column<Nested>(Hdf5Reader(name, "coseg test", 1), "rows"), Error);
}

/// Whether a column of T that holds this number in a file is refused.
template <class T>
bool is_refused(std::int8_t number) {
    const TemporaryFolder folder;
    const std::string name = folder.path() + "/column.h5";
    Hdf5Writer writer(name, "coseg test", 1);
    writer.write("column", std::vector<std::int8_t>{0, number});
    writer.commit();
    try {
        read_column<T>(Hdf5Reader(name, "coseg test", 1), "column");
        return false;
    } catch (const Error&) {
        return true;
    }
}

TEST(RecordFile, NumbersThatStandForNothingAreRefused) {
    EXPECT_FALSE(is_refused<test::Metal>(1));
    EXPECT_TRUE(is_refused<test::Metal>(2));
    EXPECT_TRUE(is_refused<test::Metal>(-1));
    EXPECT_FALSE(is_refused<bool>(1));
    EXPECT_TRUE(is_refused<bool>(2));
}

/// The sentence with which a record of Numbers is refused in whose file this field has this value; "" where
/// it is read.
template <class Value>
std::string refusal(const std::string& field, Value value) {
    const TemporaryFolder folder;
    const std::string name = folder.path("numbers.h5");
    Hdf5Writer writer(name, "coseg test", 1);
    for (const char* other : {"truth", "small", "large", "hash", "metal"})
        if (other != field) writer.attribute(other, std::int64_t{1});
    for (const char* other : {"real", "single"})
        if (other != field) writer.attribute(other, 1.0);
    writer.attribute(field, value);
    writer.commit();
    test::Numbers numbers;
    return test::error_of([&] { read_record(Hdf5Reader(name, "coseg test", 1), "", numbers); }).sentence;
}

TEST(RecordFile, ANumberThatDoesNotFitItsFieldIsRefused) {
    const std::int64_t beyond = (std::int64_t{1} << 32) + 7;
    for (const std::int64_t small : {beyond, -beyond, std::int64_t{1} << 31}) {
        const std::string sentence = refusal("small", small);
        EXPECT_NE(sentence.find("'small' holds " + std::to_string(small) + ", which stands for nothing"),
                  std::string::npos)
            << sentence;
    }
    EXPECT_EQ(refusal("small", std::int64_t{std::numeric_limits<int>::min()}), "");
    EXPECT_EQ(refusal("large", beyond), "");
    EXPECT_EQ(refusal("hash", std::int64_t{-1}), "");
    EXPECT_NE(refusal("truth", std::int64_t{2}).find("'truth' holds 2, "), std::string::npos);
    EXPECT_NE(refusal("metal", std::int64_t{2}).find("'metal' holds 2, "), std::string::npos);
    EXPECT_NE(refusal("metal", std::int64_t{1} << 32).find("'metal' holds 4294967296, "), std::string::npos);
    EXPECT_NE(refusal("single", 1e39).find("'single' holds 1e+39, "), std::string::npos);
    EXPECT_EQ(refusal("real", 1e300), "");
    EXPECT_EQ(refusal("single", std::numeric_limits<double>::infinity()), "");
}

TEST(RecordFile, MatricesOfImpossibleSizesAreRefused) {
    const std::int64_t large = std::int64_t{1} << 33;
    for (const auto& [rows, columns] :
         std::vector<std::pair<std::int64_t, std::int64_t>>{{-1, -1}, {large, large}, {2, -1}, {2, 2}}) {
        const TemporaryFolder folder;
        const std::string name = folder.path() + "/torn.h5";
        Hdf5Writer writer(name, "coseg test", 1);
        writer.write("matrices/rows", std::vector<std::int64_t>{rows});
        writer.write("matrices/columns", std::vector<std::int64_t>{columns});
        writer.write("matrices/value", std::vector<double>{1.0, 2.0, 3.0});
        writer.commit();
        EXPECT_THROW(read_column<Eigen::MatrixXd>(Hdf5Reader(name, "coseg test", 1), "matrices"), Error);
    }
}

}  // namespace
}  // namespace coseg
