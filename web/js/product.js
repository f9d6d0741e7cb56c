// product.js -- what is drawn of a sonar, by the product of its pings: an image, lines of one beam that a head turns, or
// rows of a side-scan sonar's waterfall.
// Nothing else chooses: the views ask the table.

import { turned } from "./geometry.js";

export const kRoundSlots = 1440;  // columns of a scanning head's round picture

const kProducts = {
  image: {
    pictures: ["fan", "polar"],           // the usual one first
    gathers: false,                       // whether a picture holds the lines of many pings
    columns: (sonar) => sonar.beams,      // of the picture's tables
    pings: (ping) => [ping],              // those that the picture shows
    pose: (ping) => ping.pose,            // of the beams in the world
    azimuth: (sonar, ping, beam) => sonar.beamAzimuths[beam],
    beam: (beam) => `Beam ${beam}   `,
    chosen: "   (chosen)",                // behind the chosen beam
    waterfall: null,                      // caption of the waterfall; null: that of what is chosen
    sides: false,                         // whether the waterfall shows port and starboard, the track between them
    main: null,                           // the large view when such a sonar is chosen; null: as it is
    hint: "A click on the picture chooses the beam, and the object.",
  },
  line: {
    pictures: ["round"],
    gathers: true,
    columns: () => kRoundSlots,
    pings: (ping, roundPings) => [...new Set(roundPings)],
    pose: (ping) => turned(ping.pose, ping.headAngle),
    azimuth: (sonar, ping) => ping.headAngle,
    beam: () => "",
    chosen: "",
    waterfall: "Head's beam",
    sides: false,
    main: null,
    hint: "The head has one beam: each row is a ping, in the direction that the head had then. A click on the picture chooses the object.",
  },
};

// Its picture is that of one ping, both beams side by side.
kProducts.waterfall = {
  ...kProducts.image,
  pictures: ["polar"],
  beam: (beam) => `${beam === 0 ? "Port" : "Starboard"}   `,
  waterfall: "Port   |   starboard",
  sides: true,
  main: "waterfall",
  hint: "Each row of the waterfall is a ping, the newest on top; the track runs down its middle. A click on the picture chooses the side, and the object.",
};

/** The kinds of picture of all products. */
export const kPictures = [...new Set(Object.values(kProducts).flatMap(({ pictures }) => pictures))];

// The fan of a multibeam looks down.
kProducts.swath = { ...kProducts.image, hint: "The waterfall has the depths of the soundings, a column for each beam. A click on the picture chooses the beam, and the object." };

/** What is drawn of a SONAR of `hello`. */
export const productOf = (sonar) => kProducts[sonar.type === "mbes" ? "swath" : sonar.product];

/** What is drawn of the watched sonar; before there is one, of an image. */
export const productIn = (store) => store.get("sonar")?.product ?? kProducts.image;
