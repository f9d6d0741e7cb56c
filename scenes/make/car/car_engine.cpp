// car_engine.cpp -- the engine and what stands round it, seen where the bonnet is open.

#include "car/car.h"

namespace {

// An in-line four, leaned a little to the right: block, head, rocker cover, manifolds, pulleys.
Shape make_engine() {
  Shape engine = box("cast_iron", {0.52, 0.27, 0.32});
  engine.add(box("aluminium", {0.48, 0.23, 0.11}), at({0, 0, 0.21}));
  engine.add(plate("aluminium",
                   {{-0.23, -0.08},
                    {-0.21, -0.1},
                    {0.21, -0.1},
                    {0.23, -0.08},
                    {0.23, 0.08},
                    {0.21, 0.1},
                    {-0.21, 0.1},
                    {-0.23, 0.08}},
                   {}, 0.06),
             at({0, 0, 0.255}));
  engine.add(revolve("abs", {{0, 0.3}, {0.03, 0.3}, {0.035, 0.335}, {0, 0.34}}, 10), at({0.1, 0, 0}));
  for (const double x : {-0.18, -0.06, 0.06, 0.18}) {
    engine.add(tube("cast_iron", {{x, -0.1, 0.2}, {x, -0.2, 0.19}, {0.3 * x, -0.26, 0.05}}, 0.024, 8));  // Exhaust.
    engine.add(tube("aluminium", {{x, 0.1, 0.2}, {x, 0.2, 0.22}, {0.8 * x, 0.27, 0.26}}, 0.022, 8));     // Intake.
  }
  engine.add(tube("aluminium", {{-0.22, 0.28, 0.27}, {0.22, 0.28, 0.27}}, 0.035, 10));
  engine.add(box("cast_iron", {0.16, 0.2, 0.14}), at({-0.3, 0, 0}));
  const Shape pulley = revolve("cast_iron", {{0, -0.012}, {0.08, -0.012}, {0.065, 0}, {0.08, 0.012}, {0, 0.012}}, 20);
  engine.add(pulley, at({0.29, 0, -0.08}, 0, 90));
  engine.add(pulley, at({0.29, 0.05, 0.12}, 0, 90));
  engine.add(
      revolve("aluminium", {{0, -0.09}, {0.055, -0.085}, {0.065, -0.06}, {0.065, 0.06}, {0.055, 0.085}, {0, 0.09}}, 16),
      at({0.12, -0.25, -0.07}, 0, 90));
  return engine;
}

Shape make_radiator() {
  Shape radiator = box("copper", {0.035, 0.54, 0.34});
  for (const double y : {-0.30, 0.30}) {
    radiator.add(box("brass", {0.05, 0.07, 0.37}), at({0, y, 0}));
  }
  for (const double z : spaced(-0.15, 0.15, 11)) {  // Fins.
    radiator.add(box("copper", {0.05, 0.53, 0.006}), at({0, 0, z}));
  }
  for (const double angle : spaced(0, 300, 6)) {  // The fan.
    radiator.add(placed(box("abs", {0.006, 0.055, 0.15}), at({0, 0, 0.1}, 0, 0, 25)), at({-0.11, 0, -0.02}, angle));
  }
  radiator.add(tube("steel", {{-0.02, 0, -0.02}, {-0.16, 0, -0.02}}, 0.025, 10));
  return radiator;
}

}  // namespace

Shape make_engine_bay() {
  Shape bay = placed(make_engine(), at({1.42, 0, 0.53}, 8));
  bay.add(make_radiator(), at({1.93, 0, 0.5}));
  // Tops of the front struts, the battery, the washer's bottle, the air cleaner and its hose.
  for (const double y : {-0.57, 0.57}) {
    bay.add(revolve("bodywork", {{0, 0.45}, {0.13, 0.45}, {0.11, 0.74}, {0.075, 0.775}, {0.03, 0.78}, {0, 0.795}}, 20),
            at({kWheelbase / 2 - 0.02, y, 0}));
  }
  bay.add(box("abs", {0.19, 0.17, 0.2}), at({1.76, 0.49, 0.6}));
  for (const double y : {0.45, 0.53}) {
    bay.add(revolve("lead", {{0, 0.69}, {0.012, 0.69}, {0.01, 0.725}, {0, 0.726}}, 8), at({1.71, y, 0}));
  }
  bay.add(revolve("hdpe", {{0, 0.5}, {0.07, 0.51}, {0.08, 0.66}, {0.05, 0.69}, {0.03, 0.71}, {0, 0.715}}, 14),
          at({1.74, -0.5, 0}));
  bay.add(revolve("steel", {{0, -0.05}, {0.12, -0.05}, {0.14, -0.03}, {0.14, 0.03}, {0.12, 0.05}, {0, 0.055}}, 20),
          at({1.58, 0.38, 0.7}, 0, 75));
  bay.add(tube("rubber", {{1.9, 0.2, 0.63}, {1.8, 0.15, 0.72}, {1.72, 0.06, 0.74}, {1.64, 0.02, 0.7}}, 0.028, 10));
  bay.add(tube("rubber", {{1.9, -0.2, 0.38}, {1.82, -0.15, 0.36}, {1.7, -0.08, 0.4}}, 0.028, 10));
  return bay;
}
