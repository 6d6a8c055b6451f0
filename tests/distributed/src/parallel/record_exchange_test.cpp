#include "src/parallel/record_exchange.hpp"

#include <gtest/gtest.h>

#include "tests/support/every_kind.hpp"

namespace coseg {
namespace {

using test::EveryKind;
using test::filled_record;

/// What rank r has: r records.
std::vector<EveryKind> records_of(int rank) {
    std::vector<EveryKind> records;
    for (int k = 0; k < rank; ++k) records.push_back(filled_record(10 * rank + k));
    return records;
}

TEST(RecordExchange, RecordsAreGatheredInTheOrderOfRanks) {
    const Comm comm(MPI_COMM_WORLD);
    std::vector<EveryKind> expected;
    for (int r = 0; r < comm.size(); ++r) {
        for (const EveryKind& record : records_of(r)) expected.push_back(record);
    }
    EXPECT_EQ(all_gather_records(comm, records_of(comm.rank())), expected);
    if (!comm.is_root()) expected.clear();
    EXPECT_EQ(gather_records(comm, records_of(comm.rank())), expected);
}

TEST(RecordExchange, TheRootsRecordReplacesWhatOthersHad) {
    const Comm comm(MPI_COMM_WORLD);
    EveryKind record = filled_record(comm.is_root() ? 3 : 20 + comm.rank());
    broadcast(comm, record);
    EXPECT_EQ(record, filled_record(3));
    std::vector<EveryKind> records = comm.is_root() ? records_of(2) : records_of(1);
    broadcast(comm, records);
    EXPECT_EQ(records, records_of(2));
}

TEST(RecordExchange, TextsAndNothingTravelToo) {
    const Comm comm(MPI_COMM_WORLD);
    std::vector<std::string> texts = comm.is_root()
                                         ? std::vector<std::string>{"a", "", std::string("b\0c", 3)}
                                         : std::vector<std::string>{"x"};
    broadcast(comm, texts);
    EXPECT_EQ(texts, (std::vector<std::string>{"a", "", std::string("b\0c", 3)}));
    EXPECT_TRUE(all_gather_records(comm, std::vector<EveryKind>{}).empty());
}

}  // namespace
}  // namespace coseg
