// SPDX-License-Identifier: MIT
#include "engine/json/json.h"

#include <limits>

#include <gtest/gtest.h>

namespace limn {

TEST(Json, WritesMembersInTheOrderInWhichTheyWereAdded) {
    Json json = {{"z", 1}, {"a", {1, 2.5, "x"}}};
    json["b"]["inner"] = true;
    json["z"] = nullptr;
    EXPECT_EQ(json.dump(), R"({"z":null,"a":[1,2.5,"x"],"b":{"inner":true}})");
    EXPECT_EQ(Json::array({1}).dump(2), "[\n  1\n]");
}

TEST(Json, TellsListsOfPairsFromLists) {
    EXPECT_EQ((Json{{"a", 1}}).dump(), R"({"a":1})");
    EXPECT_EQ((Json{{"a", "b"}}).dump(), R"({"a":"b"})");
    EXPECT_EQ((Json{{1, 2}, {3, 4}}).dump(), "[[1,2],[3,4]]");
    EXPECT_EQ((Json{"a", 1}).dump(), R"(["a",1])");
    EXPECT_EQ(Json(std::vector<std::string>{"a", "b"}).dump(), R"(["a","b"])");
    EXPECT_EQ(Json(std::vector<double>{}).dump(), "[]");
}

TEST(Json, KeepsTheWholeRangeOfIntegers) {
    const auto lowest = std::numeric_limits<std::int64_t>::min();
    const auto highest = std::numeric_limits<std::uint64_t>::max();
    const Result<Json> read = parseJson(Json{lowest, highest, std::int8_t(-3)}.dump());
    ASSERT_TRUE(read);
    EXPECT_EQ(read->dump(), "[-9223372036854775808,18446744073709551615,-3]");
    EXPECT_EQ((*read)[0].integerWithin<std::int64_t>(), lowest);
    EXPECT_EQ((*read)[1].integerWithin<std::uint64_t>(), highest);
    EXPECT_FALSE((*read)[0].integerWithin<std::uint64_t>());
    EXPECT_FALSE((*read)[1].integerWithin<std::int64_t>());
    EXPECT_FALSE((*read)[2].integerWithin<std::uint8_t>());
    EXPECT_EQ((*read)[2].get<double>(), -3);
    EXPECT_FALSE(Json(1.5).integerWithin<int>());
}

TEST(Json, WritesWhatIsNotFiniteAsNull) {
    EXPECT_EQ(
        (Json{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()})
            .dump(),
        "[null,null]");
}

TEST(Json, ReplacesBytesThatAreNotUtf8) {
    EXPECT_EQ(Json("a\xff"
                   "b")
                  .dump(),
              "\"a\xef\xbf\xbd"
              "b\"");
}

TEST(Json, ComparesNumbersByValueAndMembersInOrder) {
    EXPECT_EQ(Json(1), Json(1U));
    EXPECT_EQ(Json(1), Json(1.0));
    EXPECT_NE(Json(-1), Json(std::numeric_limits<std::uint64_t>::max()));
    EXPECT_NE(Json(0), Json(false));
    EXPECT_NE(Json(), Json(0));
    EXPECT_EQ((Json{{"a", 1}, {"b", 2}}), (Json{{"a", 1}, {"b", 2}}));
    EXPECT_NE((Json{{"a", 1}, {"b", 2}}), (Json{{"b", 2}, {"a", 1}}));
}

TEST(Json, FindsUpdatesAndErasesMembers) {
    Json json = {{"a", 1}};
    json.update({{"a", 2}, {"b", 3}});
    EXPECT_EQ(json.dump(), R"({"a":2,"b":3})");
    json.erase("a");
    EXPECT_FALSE(json.contains("a"));
    EXPECT_EQ(json.find("a"), nullptr);
    const Json& constant = json;
    EXPECT_TRUE(constant["a"]["of nothing"].isNull());
    EXPECT_FALSE(json.contains("a")); // reading adds nothing
}

TEST(ParseJson, ReadsWhatWasWritten) {
    const std::string text = R"({"a":[1,-2,0.1,true,null,"\u00e9\n"],"b":{"c":{}},"d":[[]]})";
    const Result<Json> read = parseJson(text);
    ASSERT_TRUE(read);
    EXPECT_EQ(parseJson(read->dump(3))->dump(), read->dump());
    EXPECT_EQ((*read)["a"][5].get<std::string>(), "\xc3\xa9\n");
    EXPECT_EQ((*read)["b"].members().front().key, "c");
}

TEST(ParseJson, TakesTheLastOfMembersOfOneName) {
    EXPECT_EQ(parseJson(R"({"a":1,"a":{"b":2}})")->dump(), R"({"a":{"b":2}})");
}

TEST(ParseJson, SaysWhereTextIsNoJson) {
    for (const char* text : {"", "[1,", "{\"a\" 1}", "nul", "[1] 2", "\"\xff\"", "1e400"}) {
        const Result<Json> read = parseJson(text);
        ASSERT_FALSE(read) << text;
        EXPECT_FALSE(read.error().message.empty()) << text;
        EXPECT_EQ(read.error().message.find("json.exception"), std::string::npos) << text;
    }
    EXPECT_NE(parseJson("[1,\n}").error().message.find("line 2, column 1"), std::string::npos);
}

TEST(ParseJson, RefusesWhatIsNestedTooDeeply) {
    EXPECT_TRUE(parseJson("[[[1]]]", 3));
    EXPECT_EQ(parseJson("[[[1]]]", 2).error().message, "nested too deeply");
    EXPECT_EQ(parseJson(std::string(1 << 20, '[')).error().message, "nested too deeply");
}

} // namespace limn
