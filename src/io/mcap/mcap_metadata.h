// mcap_metadata.h -- names of the metadata that insonify's MCAP files have.

#pragma once

namespace insonify::mcap_metadata {

inline constexpr const char* kRun = "insonify";       ///< One record about the run ...
inline constexpr const char* kOfSonar = "insonify/";  ///< ... and one for each sonar: "insonify/NAME".

/// Entry of a file that ends before its run did.
inline constexpr const char* kEnd = "insonify:end";
inline constexpr const char* kReason = "reason";  ///< The system's, as "No space left on device".

/// What an operator has marked: an entry with a JSON list of marker_text()s.
inline constexpr const char* kMarked = "insonify:markers";
inline constexpr const char* kMarkers = "markers";

inline constexpr const char* kVersion = "version";
inline constexpr const char* kModel = "model";
inline constexpr const char* kEngine = "engine";
inline constexpr const char* kSeed = "seed";
inline constexpr const char* kStart = "start";  ///< Time 0 of the pings, in the form of start_text(); absent: 1970.

inline constexpr const char* kInstances = "instance_names";  ///< Names of the scene's instances, a JSON list ...
inline constexpr const char* kMaterials = "material_names";  ///< ... and of its materials.

inline constexpr const char* kSonar = "sonar";                     ///< Its name as it is, not as topics have it.
inline constexpr const char* kSettings = "settings";               ///< A scenario file with only this sonar.
inline constexpr const char* kAbsorption = "absorption_db_per_m";  ///< Of the water at the sonar's frequency.
inline constexpr const char* kScale = "scale";     ///< Scale of the values of sonar images: db or linear.
inline constexpr const char* kLowDb = "low_db";    ///< Level of the value 0.
inline constexpr const char* kHighDb = "high_db";  ///< Level of the greatest value.
inline constexpr const char* kGainPerDecade = "gain_per_decade";  ///< Gain over range in these levels.

}  // namespace insonify::mcap_metadata
