// Which grids there is time for, by a clock of the test's own.
#include "core/plan/step_times.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace awan {
namespace {

const std::vector<int> kGrids = {8, 12, 16, 24, 32, 48, 64};

// Of the light of grids that take `scale` times cells^power ms, those before included.
std::vector<RungForecast> forecasts(double scale, double power) {
    std::vector<RungForecast> list;
    for (const Rung& rung : ladder()) {
        RungForecast forecast;
        forecast.rung = &rung;
        forecast.light_ms = rung.cells > 0 ? scale * std::pow(rung.cells, power) : 0;
        list.push_back(forecast);
    }
    return list;
}

struct Machine {
    double light = 1e-3, power = 2.9;  // of its own times, as above
    double draw = 40, measure = 10, plan = 20;
    bool kept_to_32 = false;
};

struct Climbed {
    double used = 0;
    int cells = 0;
    bool gave_up = false;
};

// As climb() does: the coarsest rung in any case, then as long as there is time.
Climbed climb(const Machine& machine, const std::vector<RungForecast>& forecasts, double asked) {
    StepTimes steps(forecasts);
    TimeSpent time{asked, machine.plan, machine.draw, machine.measure};
    Climbed climbed;
    double before = 0;
    for (const int cells : kGrids) {
        const double light = machine.light * std::pow(cells, machine.power);
        const bool kept = machine.kept_to_32 && cells <= 32;
        const double step = kept ? 0 : light - before;
        before = light;
        if (cells > 16) {
            if (!time.is_left_for(steps.next_ms(cells))) break;
            if (step > time.most_for_a_step()) {
                climbed.gave_up = true;
                time.spent += time.most_for_a_step();
                break;
            }
        }
        time.spent += step;
        if (kept) {
            steps.kept(cells);
        } else {
            steps.solved(cells, step);
        }
        climbed.cells = cells;
    }
    if (time.is_left_to_measure()) time.spent += machine.measure;
    climbed.used = time.spent + machine.draw;
    return climbed;
}

// What the finest grid of those that fit would use.
double best_use(const Machine& machine, double asked) {
    double best = 0;
    for (const int cells : {16, 24, 32, 48, 64}) {
        const double used = machine.plan + machine.light * std::pow(cells, machine.power) +
                            machine.draw + machine.measure;
        if (used <= asked || cells == 16) best = std::max(best, used);
    }
    return best;
}

TEST(StepTimes, TheFinestGridThatFitsIsReachedHoweverWrongForecastsAre) {
    for (const double asked : {90., 150., 400., 1000.})
        for (const double wrong : {0.2, 1., 5.}) {
            const Machine machine;
            const Climbed one =
                climb(machine, forecasts(wrong * machine.light, machine.power), asked);
            EXPECT_NEAR(one.used, best_use(machine, asked), 1e-6) << asked << ' ' << wrong;
            EXPECT_FALSE(one.gave_up);
        }
}

// The growth from grid to grid is forecast wrong, or the machine gets busy: no more than the overtime is used.
TEST(StepTimes, TheTimeIsNeverPassedByMoreThanTheOvertime) {
    for (const double power : {2.2, 2.9, 3.6})
        for (double asked = 75; asked < 5000; asked *= 1.13) {
            Machine machine;
            machine.power = power;
            const Climbed one = climb(machine, forecasts(1e-3, 2.6), asked);
            const double coarsest = machine.plan + machine.draw + 1e-3 * std::pow(16, power);
            EXPECT_LE(one.used, std::max(TimeSpent::kOvertime * asked, coarsest) + 1e-6)
                << power << ' ' << asked;
        }
}

// Light that was there took no time: that does not promise that the next grid takes none.
TEST(StepTimes, KeptLightSaysNothingOfTheNextStep) {
    Machine machine;
    machine.kept_to_32 = true;
    const double step_48 = machine.light * (std::pow(48, 2.9) - std::pow(32, 2.9));
    const auto right = forecasts(machine.light, machine.power);
    const double rest = machine.plan + machine.draw + machine.measure;
    EXPECT_EQ(climb(machine, right, rest + 0.9 * step_48).cells, 32);
    EXPECT_EQ(climb(machine, right, rest + 1.1 * step_48).cells, 48);
}

TEST(StepTimes, WhatCannotBeMeasuredInTimeIsNot) {
    const TimeSpent time{100, 60, 30, 10};
    EXPECT_TRUE(time.is_left_to_measure());
    EXPECT_FALSE(time.is_left_for(1));
    const TimeSpent late{100, 61, 30, 10};
    EXPECT_FALSE(late.is_left_to_measure());
    EXPECT_NEAR(late.most_for_a_step(), 110 - 91, 1e-9);
}

TEST(StepTimes, NoForecastIsNoTime) {
    StepTimes steps({});
    EXPECT_EQ(steps.next_ms(16), 0);
    steps.solved(16, 5);
    EXPECT_TRUE(std::isfinite(steps.next_ms(24)));
}

}  // namespace
}  // namespace awan
