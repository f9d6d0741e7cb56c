// colour_maps.js -- colour maps from weak to strong echoes, and colours of labels.

// Evenly spaced colours, linear between them. Inferno: S. van der Walt and N. Smith (2015, CC0), every eighth of its 256
// colours. Turbo: A. Mikhailov (2019, Apache 2.0), every eighth. Copper: red 1.25 v, green 0.7812 v, blue 0.4975 v.
const kAnchors = {
  inferno: "0000040403120b0724150b37210c4a2e0a5a3c09654a0c6b57106d63146e70196e7d1e6d89226a962766a32b61af315cbb3755c63e4dd14644db4f3be35932eb6528f1711ef67f14f98d0afb9c06fcab0ffbba1ff9ca32f5d949f2e865f3f586fcffa4",
  copper: "000000402819805033bf784cff9f65ffc77f",
  grey: "000000ffffff",
  turbo: "30123b392a734040a24456c7466be34680f64294ff37a8fa28bceb1ccdd818ddc21fe9af32f2984ef97d6dfe628bff4ba4fc3cb9f635cdec34dfdf37eecf3af8be39fdac34fe962bfb7e21f46617eb500edf3f08d02f05be2102a91601920b017a0403",
  blue: "00030c04173a08306b0b4b931669b52d89cf52a8e083c5ebb7def4f2fbff",
};

/** 256 colours of a map, as RGBA bytes. */
export function colourTable(name) {
  const anchors = kAnchors[name].match(/../g).map((pair) => parseInt(pair, 16));
  const last = anchors.length / 3 - 1;
  const table = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) {
    const place = (i / 255) * last;
    const below = Math.min(Math.floor(place), last - 1);
    for (let channel = 0; channel < 3; ++channel) {
      const [a, b] = [anchors[3 * below + channel], anchors[3 * below + 3 + channel]];
      table[4 * i + channel] = Math.round(a + (place - below) * (b - a));
    }
    table[4 * i + 3] = 255;
  }
  return table;
}

/** Colour [r, g, b] of a label; neighbouring labels have hues far apart. */
export function labelColour(label) {
  const hue = (label * 0.61803398875 + 0.08) % 1;
  const light = 0.58 + 0.1 * (label % 3);
  const channel = (offset) => {
    const k = (offset + hue * 12) % 12;
    return Math.round(255 * (light - 0.75 * Math.min(light, 1 - light) * Math.max(-1, Math.min(k - 3, 9 - k, 1))));
  };
  return [channel(0), channel(8), channel(4)];
}

/** Colours of 256 labels as RGBA bytes; labels beyond begin again. */
export function labelTable() {
  const table = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) table.set([...labelColour(i), 255], 4 * i);
  return table;
}
