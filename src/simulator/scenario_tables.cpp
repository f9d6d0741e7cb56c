// scenario_tables.cpp -- the tables of a scenario's structs, the only place that compiles their lists of fields.

#include "insonify/scenario.h"

namespace insonify {

template const SettingsTable& table_of<ProfilePoint>();
template const SettingsTable& table_of<Water>();
template const SettingsTable& table_of<PaperModel>();
template const SettingsTable& table_of<ReceiverConfig>();
template const SettingsTable& table_of<Sampling>();
template const SettingsTable& table_of<SonarConfig>();
template const SettingsTable& table_of<MaterialOverride>();
template const SettingsTable& table_of<Material>();
template const SettingsTable& table_of<PointTarget>();
template const SettingsTable& table_of<Interferer>();
template const SettingsTable& table_of<Thruster>();
template const SettingsTable& table_of<SeaSurface>();
template const SettingsTable& table_of<Waypoint>();
template const SettingsTable& table_of<SurveyPattern>();
template const SettingsTable& table_of<SurveyLines>();
template const SettingsTable& table_of<MotionNoise>();
template const SettingsTable& table_of<PingSpan>();
template const SettingsTable& table_of<Motion>();
template const SettingsTable& table_of<ViewConfig>();
template const SettingsTable& table_of<Scenario>();

}  // namespace insonify
