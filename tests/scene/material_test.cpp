// material_test.cpp -- reflection of materials, and the library of materials.

#include "insonify/material.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>

#include "insonify/acoustics/backscatter.h"
#include "insonify/acoustics/reflection.h"
#include "support/message_of.h"
#include "support/relative.h"

namespace insonify::material_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

struct Known {
  const char* name;
  double coefficient;  // Against sea water.
};

// (Z - Zw)/(Z + Zw) with Zw = 1.539e6, computed independently of this code from the same densities and sound speeds.
constexpr Known kSolids[] = {
    {"air", -0.9994631554457708},
    {"steel", 0.9356793580473941},
    {"corroded_steel", 0.9356793580473941},
    {"fouled_steel", 0.9356793580473941},
    {"stainless_steel", 0.9348186548247537},
    {"cast_iron", 0.9111918982082576},
    {"aluminium", 0.8369098712446352},
    {"titanium", 0.8933250155957579},
    {"copper", 0.9334893459785688},
    {"brass", 0.9266426749922544},
    {"lead", 0.8817672682016179},
    {"glass", 0.8038115877366308},
    {"concrete", 0.7045781744889145},
    {"granite", 0.8089859749286334},
    {"basalt", 0.8041237113402062},
    {"limestone", 0.6477857878475798},
    {"chalk", 0.548614166300044},
    {"moraine", 0.4536741214057508},
    {"pvc", 0.3618609279761164},
    {"acrylic", 0.36028265613634003},
    {"hdpe", 0.20502092050209206},
    {"ldpe", 0.07650765076507651},
    {"abs", 0.21107266435986158},
    {"nylon", 0.3084700067400584},
    {"polystyrene", 0.24168514412416853},
    {"polyurethane", 0.006776379477250726},
    {"grp", 0.5446071904127829},
    {"rubber", -0.022082018927444796},
    {"neoprene", 0.153232462173315},
    {"silicone", -0.1079913606911447},
    {"neoprene_foam", -0.8779743746186699},
    {"syntactic_foam", -0.012833168805528134},
    {"dry_wood", -0.17525773195876287},
    {"wood", 0.06698999696877841},
    {"ice", 0.3917332637719652},
    {"tissue", 0.029450715772214163},
    {"bone", 0.6241299303944315},
};

class MaterialTest : public testing::TestWithParam<Known> {};

TEST_P(MaterialTest, ReflectsAsItsImpedanceSays) {
  const Material* material = find_material(GetParam().name);
  ASSERT_NE(material, nullptr);
  EXPECT_THAT(material->reflection_coefficient(kSeaWaterImpedance), RelativelyNear(GetParam().coefficient));
  EXPECT_THAT(material->effective_reflectivity(), RelativelyNear(std::abs(GetParam().coefficient)));
}

INSTANTIATE_TEST_SUITE_P(Solids, MaterialTest, testing::ValuesIn(kSolids));

// |R| at normal incidence from TR 9407's table 2, which also counts the sediment's losses: they change it by less than
// 1e-4 of itself, except for the two that are nearly as heavy and as fast as water.
constexpr Known kSediments[] = {
    {"rock", 0.7241391105624475},         {"gravel", 0.6363665541679098},
    {"sandy_gravel", 0.538336503019882},  {"very_coarse_sand", 0.5166359979904891},
    {"coarse_sand", 0.47213898143852856}, {"sand", 0.3697748698040563},
    {"fine_sand", 0.2328593125701292},    {"very_fine_sand", 0.14538717418179833},
    {"clayey_sand", 0.1185738882276691},  {"silt", 0.09802256270413189},
    {"sandy_silt", 0.0780598783499639},   {"sandy_mud", 0.06287763487452573},
    {"sandy_clay", 0.06107076346597977},  {"mud", 0.05926964802802353},
    {"clay", 0.05746935206456267},
};

class SedimentTest : public testing::TestWithParam<Known> {};

TEST_P(SedimentTest, ReflectsAsTheHandbookSays) {
  constexpr double kLosses = 0.01;
  const Material* material = find_material(GetParam().name);
  ASSERT_NE(material, nullptr);
  EXPECT_NEAR(material->effective_reflectivity(), GetParam().coefficient, kLosses * GetParam().coefficient);
}

INSTANTIATE_TEST_SUITE_P(Sediments, SedimentTest, testing::ValuesIn(kSediments));

// By hand: 1000 x 3000 = 3e6 against 1e6: (3 - 1)/(3 + 1).
TEST(MaterialRuleTest, CoefficientIsTheDifferenceOfImpedancesOverTheirSum) {
  const Material material{.density = 1000, .sound_speed = 3000};
  EXPECT_DOUBLE_EQ(material.reflection_coefficient(1e6), 0.5);
  EXPECT_DOUBLE_EQ(material.reflection_coefficient(9e6), -0.5);
  EXPECT_EQ(material.reflection_coefficient(3e6), 0);
}

TEST(MaterialRuleTest, AGivenReflectivityOverrulesTheImpedance) {
  const Material material{.density = 7850, .sound_speed = 5900, .reflectivity = 0.25};
  EXPECT_EQ(material.effective_reflectivity(), 0.25);
}

TEST(MaterialLibraryTest, IsInAlphabeticalOrderWithoutRepeats) {
  EXPECT_TRUE(std::ranges::is_sorted(material_library(), std::ranges::less_equal{}, &Material::name));
}

TEST(MaterialLibraryTest, EveryEntryIsCheckedAboveAndNamesItsSource) {
  EXPECT_EQ(material_library().size(), std::size(kSolids) + std::size(kSediments));
  for (const Material& material : material_library()) {
    EXPECT_NO_THROW(check_fields(material.name, material)) << material.name;
    EXPECT_FALSE(material.source.empty()) << material.name;
    EXPECT_EQ(material.reflectivity, std::nullopt) << material.name;
    EXPECT_EQ(find_material(material.name), &material);
  }
}

// Rows of the tables in the documentation: "| steel | 7850 | 5900 | 0.936 | 1 | mild_steel |".
TEST(MaterialLibraryTest, IsWhatTheDocumentationShows) {
  std::ifstream page(INSONIFY_SOURCE_DIR "/docs/concepts/materials.md");
  ASSERT_TRUE(page.is_open());
  const std::regex row(R"(\| (\w+) \| ([\d.]+) \| (\d+) \| ([\d.]+) \| . \| (.*) \|)");
  std::size_t rows = 0;
  std::smatch cells;
  for (std::string line; std::getline(page, line);) {
    if (std::regex_match(line, cells, row)) {
      ++rows;
      const Material* material = find_material(cells[1].str());
      ASSERT_NE(material, nullptr) << line;
      EXPECT_NEAR(material->density, std::stod(cells[2]), 0.5) << line;
      EXPECT_NEAR(material->sound_speed, std::stod(cells[3]), 0.5) << line;
      EXPECT_NEAR(material->effective_reflectivity(), std::stod(cells[4]), 0.0005) << line;
      std::istringstream aliases(cells[5]);
      for (std::string alias; std::getline(aliases >> std::ws, alias, ',');) {
        EXPECT_EQ(find_material(alias), material) << line;
      }
    }
  }
  EXPECT_EQ(rows, material_library().size());
}

TEST(FindMaterialTest, CaseAndGapsDoNotMatter) {
  const Material* fine_sand = find_material("fine_sand");
  ASSERT_NE(fine_sand, nullptr);
  for (const char* name : {"fine-sand", "fine sand", "Fine_Sand", "FINE SAND"}) {
    EXPECT_EQ(find_material(name), fine_sand) << name;
  }
}

TEST(FindMaterialTest, KnowsOtherCommonNames) {
  EXPECT_EQ(find_material("Aluminum"), find_material("aluminium"));
  EXPECT_EQ(find_material("silty-clay"), find_material("mud"));
  EXPECT_EQ(find_material("medium sand"), find_material("sand"));
  EXPECT_EQ(find_material("plexiglass"), find_material("acrylic"));
}

TEST(FindMaterialTest, DoesNotGuess) {
  EXPECT_EQ(find_material("stel"), nullptr);
  EXPECT_EQ(find_material("finesand"), nullptr);
  EXPECT_EQ(find_material(""), nullptr);
}

TEST(MaterialReflectionTest, IsThatOfItsImpedanceUnlessItIsGiven) {
  Material sand;
  sand.density = 1950;
  sand.sound_speed = 1725;
  EXPECT_NEAR(sand.reflection_at(100e3), sand.reflection_coefficient(kSeaWaterImpedance), 1e-12);
  sand.reflection = 0.3;
  EXPECT_EQ(sand.reflection_at(100e3), 0.3);
}

// pi mu of Lambert's law, plus |R|^2 of the mirror, which the lobe of facets has too: the hemisphere of directions out,
// summed at an incidence of 0, 30 and 60 degrees, gets no more than falls on the surface.
TEST(MaterialEnergyTest, NoneOfTheLibraryGivesMoreThanItGets) {
  constexpr double kStep = 0.5 * kPi / 180;
  for (const Material& material : material_library()) {
    for (const double frequency : {100e3, 720e3, 2.1e6}) {
      const Scattering surface = material.scattering(frequency);
      EXPECT_LE(kPi * surface.lambert + surface.reflection * surface.reflection, 1 + 1e-12) << material.name;
      for (int degrees = 0; degrees <= 90; ++degrees) {
        EXPECT_LE(kPi * surface.lambert + surface.reflectance(std::cos(degrees * kPi / 180)), 1 + 1e-12)
            << material.name << ", " << degrees;
      }
    }
    if (material.rms_slope < 0.1) {
      continue;  // The lobe is too narrow for these steps; its share is |R|^2 (facet lobes conserve energy).
    }
    const Scattering surface = material.scattering(720e3);
    for (const double incidence : {0.0, 30.0, 60.0}) {
      const Vec3 in(std::sin(incidence * kPi / 180), 0, std::cos(incidence * kPi / 180));
      double sum = 0;
      for (double polar = 0.5 * kStep; polar < kPi / 2; polar += kStep) {
        for (double azimuth = 0; azimuth < 2 * kPi; azimuth += 4 * kStep) {
          const Vec3 out(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
          const double tilt = half_vector_tilt(Vec3::UnitZ(), in, out);
          sum += (lambert_scatter(surface.lambert, incidence * kPi / 180, polar) +
                  facet_scatter(std::sqrt(surface.reflectance(in.dot((in + out).normalized()))), surface.rms_slope,
                                tilt)) *
                 std::sin(polar) * kStep * 4 * kStep;
        }
      }
      // Facets see the sound under cos / cos(tilt), not cos: rough ones send out up to 1 + s^2 tan^2 too much.
      const double facets = std::pow(surface.rms_slope * std::tan(incidence * kPi / 180), 2);
      EXPECT_LE(sum / in.z(), 1.01 + facets) << material.name << ", " << incidence << " degrees";
    }
  }
}

// Loss of the reflected energy by angle: TR 9407 eqs 30 to 33, computed independently; the critical angle of sand is
// 31.92 degrees of grazing. At 5 degrees its 0.2093 dB would leave less than the diffuse part, pi 10^-1.59 = 0.0808,
// takes: -10 log10(1 - 0.0808) = 0.3657 dB. The tolerance is that of tables of 0.2 degrees.
TEST(MaterialReflectionTest, BottomsReflectAtLowAnglesAsTheHandbookSays) {
  const auto loss_db = [](const char* name, double grazing_deg) {
    const double sine = std::sin(grazing_deg * kPi / 180);
    return -10 * std::log10(find_material(name)->scattering(300e3).reflectance(sine));
  };
  EXPECT_NEAR(loss_db("sand", 5), 0.3657, 1e-3);
  EXPECT_NEAR(loss_db("sand", 10), 0.3686, 2e-3);
  EXPECT_NEAR(loss_db("sand", 20), 0.5643, 2e-3);
  EXPECT_NEAR(loss_db("sand", 30), 1.1535, 0.02);
  EXPECT_NEAR(loss_db("sand", 45), 6.5495, 0.01);
  EXPECT_NEAR(loss_db("sand", 60), 7.9747, 2e-3);
  EXPECT_NEAR(loss_db("sand", 90), 8.6413, 2e-3);
  EXPECT_NEAR(loss_db("silty clay", 5), 9.013, 0.05);
  EXPECT_NEAR(loss_db("silty clay", 45), 25.890, 0.02);
}

// Steel is a perfect mirror beyond 28 degrees, but for what it scatters: pi 10^-3 = 0.00314. A |R| that is given holds
// at all angles.
TEST(MaterialReflectionTest, SolidsReflectAllBeyondTheirCriticalAngles) {
  Material steel = *find_material("steel");
  for (const double incidence : {30.0, 60.0, 85.0}) {
    EXPECT_NEAR(steel.scattering(720e3).reflectance(std::cos(incidence * kPi / 180)), 1 - 0.0031416, 1e-6);
  }
  EXPECT_NEAR(steel.scattering(720e3).reflectance(1), 0.935679358 * 0.935679358, 1e-6);
  steel.reflection = 0.5;
  EXPECT_EQ(steel.scattering(720e3).reflectance(0.5), 0.25);
}

// Rough parameters at 720 kHz, where k = 3015.93 per m: 4 k^2 h^2. Sand: its spectrum w2 = 0.00445 cm^4 beyond 2 pi/10
// per cm, with gamma 3.25, has h^2 = 2 pi 0.00445 0.62832^-1.25/1.25 = 0.03998 cm^2, h = 2.0 mm.
TEST(MaterialRoughnessTest, HeightsOfTheLibrary) {
  EXPECT_NEAR(find_material("painted steel")->scattering(720e3).roughness, 0.032745, 1e-5);
  EXPECT_NEAR(find_material("concrete")->scattering(720e3).roughness, 3.2745, 1e-3);
  EXPECT_LT(find_material("glass")->scattering(720e3).roughness, 1e-6);
  EXPECT_NEAR(find_material("sand")->rms_height, 2.0e-3, 0.01e-3);
  const auto height = [](const char* name) { return find_material(name)->rms_height; };
  EXPECT_LT(height("steel"), height("corroded_steel"));
  EXPECT_LT(height("corroded_steel"), height("fouled_steel"));
  EXPECT_LT(height("mud"), height("sand"));
  EXPECT_LT(height("sand"), height("rock"));
}

// Rock scatters back nearly all, so that as a mirror it is left 1 - pi 10^-0.5 = 0.00654 = 0.0809^2, instead of the
// 0.724^2 of its impedance; sand keeps its own.
TEST(MaterialEnergyTest, WhatIsScatteredIsNotReflected) {
  EXPECT_NEAR(find_material("rock")->reflection_at(720e3), 0.08088, 1e-5);
  EXPECT_NEAR(find_material("sand")->reflection_at(720e3), 0.36977, 1e-4);
  Material steel = *find_material("steel");
  steel.lambert_db = -8;  // 1 - pi 10^-0.8 = 0.50209.
  EXPECT_NEAR(steel.reflection_at(720e3), std::sqrt(0.50209), 1e-5);
  steel.reflection = 0.9;
  EXPECT_EQ(steel.reflection_at(720e3), 0.9);
}

// A sheet of steel a tenth of a wavelength of its own thick lets something through, one of half a wavelength all.
TEST(MaterialReflectionTest, PlatesLetSoundThrough) {
  Material steel;
  steel.density = 7850;
  steel.sound_speed = 5900;
  steel.lambert_db = -40;
  steel.thickness = 5900 / 700e3 / 10;
  EXPECT_NEAR(steel.reflection_at(700e3), plate_reflection(kSeaWaterImpedance, 7850, 5900, *steel.thickness, 700e3),
              1e-12);
  steel.thickness = 5900 / 700e3 / 2;
  EXPECT_NEAR(steel.reflection_at(700e3), 0, 1e-9);
  EXPECT_NEAR(steel.scattering(700e3).reflection, 0, 1e-9);
}

// What passes, comes back and is scattered is at most what falls on a surface; of a lossless plate of which mu is small
// it is all.
TEST(MaterialTransmissionTest, KeepsTheEnergy) {
  for (const char* name : {"acrylic", "steel", "hdpe", "glass", "sand", "granite"}) {
    Material plate = *find_material(name);
    for (const double open_share : {0.0, 0.4, 1.0}) {
      plate.open_share = open_share;
      for (const double thickness : {2e-4, 3e-3, 2e-2}) {
        plate.thickness = thickness;
        const Scattering surface = plate.scattering(720e3);
        for (int degrees = 0; degrees <= 90; ++degrees) {
          const double cosine = std::cos(degrees * kPi / 180);
          const double sum = kPi * surface.lambert + surface.reflectance(cosine) + surface.transmittance(cosine);
          EXPECT_LE(sum, 1 + 1e-9) << name << ", " << thickness << ", " << degrees;
          EXPECT_GE(surface.transmittance(cosine), open_share - 1e-12);
          if (plate.loss == 0) {
            EXPECT_GE(sum, 1 - 2 * kPi * std::pow(10, plate.lambert_db / 10)) << name << ", " << thickness;
          }
        }
      }
    }
  }
}

// 3 mm of acrylic at 720 kHz: |T|^2 = 0.605254332 at normal incidence, 0.130089617 at 35 degrees (six equations).
// Solids and bottoms let nothing through; a given transmission holds at all angles, as far as the reflection leaves it.
TEST(MaterialTransmissionTest, IsThatOfAPlateUnlessItIsGiven) {
  Material acrylic = *find_material("acrylic");
  EXPECT_EQ(acrylic.scattering(720e3).passed, nullptr);
  EXPECT_EQ(acrylic.transmission_at(720e3), 0);
  acrylic.thickness = 3e-3;
  EXPECT_NEAR(acrylic.scattering(720e3).transmittance(1), 0.605254332, 2e-3);  // Lambert's law takes 0.001.
  EXPECT_NEAR(acrylic.scattering(720e3).transmittance(std::cos(35 * kPi / 180)), 0.130089617, 2e-3);
  EXPECT_NEAR(acrylic.transmission_at(720e3), std::sqrt(0.605254332), 2e-3);
  acrylic.transmission = 0.3;
  EXPECT_EQ(acrylic.transmission_at(720e3), 0.3);
  EXPECT_NEAR(acrylic.scattering(720e3).transmittance(1), 0.09, 1e-12);
  Material net = *find_material("nylon");
  net.reflection = 0;
  net.open_share = 0.8;
  const Scattering surface = net.scattering(720e3);
  EXPECT_DOUBLE_EQ(surface.transmittance(1), 0.8);
  EXPECT_DOUBLE_EQ(surface.transmittance(0.1), 0.8);
  EXPECT_NEAR(surface.lambert, 0.2e-3, 1e-12);
}

}  // namespace
}  // namespace insonify::material_test
