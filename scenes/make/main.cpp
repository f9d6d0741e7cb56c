// main.cpp -- writes the meshes of the shipped scenes: make_meshes FOLDER.

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "car/car.h"
#include "car/car_site.h"
#include "cooler/cooler.h"
#include "cooler/cooler_site.h"
#include "cooler/pipelines.h"
#include "ferry/debris.h"
#include "ferry/ferry.h"
#include "ferry/site.h"
#include "kit/obj.h"
#include "kit/seabed.h"
#include "ssiv/ssiv.h"
#include "ssiv/ssiv_site.h"
#include "tank/cone.h"
#include "tank/tank.h"
#include "tree/tree.h"
#include "tree/tree_site.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: make_meshes FOLDER\n");
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    const auto write = [&](const std::string& name, const Shape& shape, const Cover* cover = nullptr) {
      write_obj(folder, name, shape, cover);
      fmt::print("{}: {} triangles\n", name, shape.faces.size());
    };
    write("ferry", make_ferry());
    const Cover ripples{"seabed_ripples.png", kBedArea};
    write_normal_map(folder / ripples.normal_map, bed_ripples, ripples.area, kBedMapTexels);
    write("seabed", make_seabed(), &ripples);
    write("boulders", make_boulders(boulders(), bed_height, 100));
    write("debris", make_debris());
    write("cone", make_cone());
    write("tank", make_tank());
    write("vehicle_box", make_vehicle_box());
    write("car", make_wrecked_car());
    write("car_debris", make_car_debris());
    write("car_bed", make_car_bed());
    write("car_stones", make_car_stones());
    write("christmas_tree", make_christmas_tree());
    write("tree_bed", make_tree_bed());
    write("tree_lines", make_tree_lines());
    write("cooler", make_cooler());
    write("cooler_bed", make_cooler_bed());
    write("pipelines", make_pipelines());
    write("pipeline_supports", make_pipeline_supports());
    write("ssiv", make_ssiv());
    write("ssiv_bed", make_ssiv_bed());
    write("ssiv_surroundings", make_ssiv_surroundings());
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "make_meshes: {}\n", error.what());
    return 1;
  }
}
