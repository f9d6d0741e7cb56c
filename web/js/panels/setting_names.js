// setting_names.js -- which settings have a place of their own among the controls, and what they are called there.

// `S` stands for the watched sonar: its own receiver is what acts on it.
const kSonar = [
  ["S.max_range", "Range"], ["S.min_range", "Nearest range"], ["S.bin_count", "Bins"], ["S.gain", "Gain"],
  ["S.receiver.time_varied_gain", "TVG"], ["S.ping_period", "Ping period"], ["S.step_deg", "Step of the head"],
  ["S.sector_width_deg", "Sector"],
];
const kModel = [
  ["model", "Model"], ["S.receiver.noise", "Noise"], ["S.receiver.speckle", "Speckle"],
  ["S.receiver.ambient_noise_db", "Ambient noise"], ["surface", "Sea surface"], ["surface.level", "Its level"],
  ["surface.wind_speed", "Wind"], ["ground_truth", "Ground truth"], ["secondary", "Secondary echoes"], ["seed", "Seed"],
];
const kOrder = [...kSonar, ...kModel].map(([key]) => key);
const kLabels = new Map([...kSonar, ...kModel]);
const kSonarKeys = new Set(kSonar.map(([key]) => key));

/** A key with the watched sonar's prefix as `S`, or null where it belongs to another sonar. */
export function generalKey(path, index, name) {
  for (const prefix of [`sonars[${index}].`, `sonars.${name}.`]) {
    if (path.startsWith(prefix)) return `S.${path.slice(prefix.length)}`;
  }
  return /^sonars[[.]/.test(path) ? null : path;
}

/** A message of the server about a setting, with the name that the setting has among the controls. */
export const plainError = (text) =>
  text.replace(/^--set( .*?)?: /, "")
    .replace(/\bsonars(\[\d+\]|\.[^.\s]+)\.([\w.]+)/g, (_, sonar, key) => labelOf(`S.${key}`))
    .replace(/\b[a-z]+_[a-z_]+\b/g, (word) => kLabels.get(`S.${word}`)?.toLowerCase() ?? word);

/** Group of controls that a key stands in: sonar, model or more. */
export const groupOf = (key) => (kSonarKeys.has(key) ? "sonar" : kLabels.has(key) ? "model" : "more");

/** Orders keys: those with a place first, the others as they came. */
export const rankOf = (key) => (kLabels.has(key) ? kOrder.indexOf(key) : kOrder.length);

export const labelOf = (key) => kLabels.get(key) ?? key.replace(/^S\./, "").replace(/\.(?=[^.]*$)/, ": ").replaceAll("_", " ").replace(/ (deg|db|c)$/, "");
