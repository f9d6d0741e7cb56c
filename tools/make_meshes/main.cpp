// main.cpp -- writes the meshes of the shipped scenes: make_meshes FOLDER.

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "cooler.h"
#include "cooler_site.h"
#include "debris.h"
#include "ferry.h"
#include "obj.h"
#include "pipelines.h"
#include "seabed.h"
#include "site.h"
#include "ssiv.h"
#include "ssiv_site.h"
#include "tank.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: make_meshes FOLDER\n");
    return 2;
  }
  try {
    using namespace modelling;
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    const auto write = [&](const std::string& name, const Shape& shape) {
      write_obj(folder, name, shape);
      fmt::print("{}: {} triangles\n", name, shape.faces.size());
    };
    write("ferry", make_ferry());
    write("seabed", make_seabed());
    write("boulders", make_boulders(boulders(), bed_height, 100));
    write("debris", make_debris());
    write("tank", make_tank());
    write("vehicle_box", make_vehicle_box());
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
