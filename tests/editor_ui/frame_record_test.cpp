// SPDX-License-Identifier: MIT
#include "editor_ui/panels/frame_record.h"

#include <gtest/gtest.h>

namespace limn::frame_record_test {
namespace {

FrameTime taking(double panels, double viewport = 0) {
    return {.panels = panels, .viewport = viewport};
}

WorkSet only(Work work) {
    return WorkSet().set(std::size_t(work));
}

TEST(FrameRecord, TheViewportsTimeMakesNoFrameLonger) {
    FrameRecord record;
    record.add(taking(5), {});
    record.add(taking(3, 100), {});
    EXPECT_EQ(record.sinceStart.beyondViewport(), 5);
    EXPECT_EQ(record.last.total(), 103);
    EXPECT_EQ(record.last.beyondViewport(), 3);
}

TEST(FrameRecord, ALongFrameOfTheStartIsForgottenAfterIdle) {
    FrameRecord record;
    record.add(taking(900), {});
    record.idle();
    EXPECT_EQ(record.sinceIdle.total(), 900) << "shown until something happens";
    record.add(taking(4), {});
    record.add(taking(7), {});
    record.add(taking(6), {});
    EXPECT_EQ(record.sinceIdle.total(), 7);
    EXPECT_EQ(record.sinceStart.total(), 900);
}

TEST(FrameRecord, EachWorkHasTheLongestFrameOfItsLatestRun) {
    FrameRecord record;
    record.add(taking(50), only(Work::Bake));
    record.add(taking(80), only(Work::Save) | only(Work::Bake));
    record.add(taking(200), {});
    EXPECT_EQ(record.of(Work::Bake).total(), 80);
    EXPECT_EQ(record.of(Work::Save).total(), 80);
    EXPECT_EQ(record.of(Work::Explain).total(), 0);
    record.add(taking(10), only(Work::Bake));
    record.add(taking(20), only(Work::Bake));
    EXPECT_EQ(record.of(Work::Bake).total(), 20) << "a new run";
    EXPECT_EQ(record.of(Work::Save).total(), 80);
}

} // namespace
} // namespace limn::frame_record_test
