// How long the next grid of a climb (core/climb.h) will take, by what those before took; and whether there is time for
// it. Pure arithmetic on times: no clock.
#pragma once

#include <array>
#include <vector>

#include "core/plan/forecast.h"

namespace awan {

// Times in ms, of steps from each grid to the next finer one. What is forecast gives the growth from step to step, and
// the steps that were solved in this very render give the scale: the machine, its other work, the scene.
class StepTimes {
  public:
    // forecasts: of a plan, every transport rung's among them.
    explicit StepTimes(const std::vector<RungForecast>& forecasts);

    // The grid with so many cells was solved in `ms`, and is what the next one goes on from.
    void solved(int cells, double ms);
    // It was there already: it says nothing of the time of the next.
    void kept(int cells);
    // Of the step to this one, finer than those that were told of.
    double next_ms(int cells) const;

  private:
    struct Known {
        int cells;
        double ms;
    };
    // Forecast of the light of a grid, those before it included; grows with the cells.
    double light_ms(double cells) const;

    std::vector<Known> forecasts_;
    int reached_ = 0;
    // Of the solved steps, the later ones weighing more.
    double took_ms_ = 0, expected_ms_ = 0;
};

// What a render has spent of the time that it was asked to take, and what it must still do, ms.
struct TimeSpent {
    double asked = 0, spent = 0, draw = 0, measure = 0;

    // Whether it can solve on for `next` ms.
    bool is_left_for(double next) const { return spent + next + measure + draw <= asked; }
    // Whether it can measure its error.
    bool is_left_to_measure() const { return spent + measure + draw <= asked; }
    // A solve that has not ended by then is given up, however near it may be: how long it may take from now on.
    double most_for_a_step() const { return kOvertime * asked - spent - draw; }

    static constexpr double kOvertime = 1.1;
};

}  // namespace awan
