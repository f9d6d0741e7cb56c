// own_scene.cpp -- a scene built in code, pinged, recorded and drawn:
//
//     own_scene FOLDER    # writes FOLDER/bow.h5 and FOLDER/bow.png

#include <insonify/error.h>
#include <insonify/files.h>
#include <insonify/picture.h>
#include <insonify/simulator.h>

#include <cstdio>
#include <filesystem>
#include <memory>

namespace {

void add(insonify::Scene& scene, const char* name, insonify::Mesh mesh, const insonify::Vec3& position,
         const char* material) {
  insonify::Instance instance;
  instance.name = name;
  instance.mesh = std::make_shared<insonify::Mesh>(std::move(mesh));
  instance.world_from_mesh.position = position;
  instance.user_material = material;
  scene.instances.push_back(std::move(instance));
}

void simulate(const std::filesystem::path& folder) {
  insonify::Scene scene;
  add(scene, "seabed", insonify::make_plane(insonify::Vec3::UnitZ(), 60, 60), {15, 0, -4}, "sand");
  add(scene, "boulder", insonify::make_sphere(0.8), {9, 1.5, -3.5}, "rock");
  insonify::assign_materials(scene, {});  // Looks the names up in the library of materials.

  insonify::Scenario scenario;
  insonify::SonarConfig& sonar = scenario.sonars.emplace_back();
  const insonify::Preset preset = insonify::load_preset("tritech-gemini-720i");
  sonar = preset.sonar;
  sonar.name = "bow";
  sonar.max_range = 20;
  preset.fit_to_range(sonar, 1500);  // The bins that the instrument has over this range, in water of 1500 m/s.
  sonar.orientation = {0, insonify::radians_from_degrees(15), 0};  // 15 degrees down.

  insonify::Simulator simulator(scenario, scene);
  const insonify::Ping ping = simulator.make_ping(0, 0);
  insonify::Recording recording(folder / "bow.h5", simulator.scenario(), simulator.scene(), simulator.sonar(0),
                                {.replace = true});
  recording.add(ping);
  recording.close();

  const insonify::Ping shown = insonify::raised_by_range(
      ping, simulator.sonar(0), insonify::kShownGainPerDecade);  // The far as bright as the near.
  insonify::Display display;
  display.scale = insonify::Scale::kDecibel;
  display.full_scale = insonify::fitting_full_scale(insonify::intensities_to_fit(shown, simulator.sonar(0)));
  insonify::write_png(folder / "bow.png", insonify::draw_fan(shown, simulator.sonar(0), display));
  std::printf("%s and %s\n", (folder / "bow.h5").c_str(), (folder / "bow.png").c_str());
}

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 2) {
    std::fprintf(stderr, "usage: own_scene FOLDER\n");
    return 2;
  }
  try {
    simulate(arguments[1]);
    return 0;
  } catch (const insonify::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
