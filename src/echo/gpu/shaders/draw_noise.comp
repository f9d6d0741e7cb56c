#version 460
// draw_noise.comp -- white noise in rows of bins: draw_normals() of the host. An invocation draws four numbers of a row's
// real or imaginary part, by Box and Muller.

#extension GL_GOOGLE_include_directive : require
#include "reception.glsl"
#include "philox.glsl"

layout(local_size_x = kGroup) in;

const uint kQuarter = kNoiseBlock / 4;

void main() {
  const PingAt ping = Pings(job.pings).at[job.first + gl_WorkGroupID.y];
  if (ping.reception.tables == 0) {
    return;
  }
  const ReceiverTables tables = ReceiverAt(ping.reception.tables).tables;
  const uint blocks = (tables.bins + tables.noise_tap_count - 1 + kNoiseBlock - 1) / kNoiseBlock;
  const uint i = INVOCATION % kQuarter, block = INVOCATION / kQuarter % blocks,
             row = INVOCATION / (kQuarter * blocks) / 2, part = INVOCATION / (kQuarter * blocks) % 2;
  if (row >= tables.noise_rows) {
    return;
  }
  const uint number[2] = ping.reception.number;
  const uvec4 words = philox(uvec4(block * kQuarter + i, row, number[0], (kNoiseInPhase + part) ^ number[1] << 8),
                             uvec2(tables.seed[0], tables.seed[1]));
  const float radius1 = sqrt(-2.0 * fast_log(uniform_open(words.x))),
              radius2 = sqrt(-2.0 * fast_log(uniform_open(words.z)));
  const SineCosine angle1 = fast_sine_cosine(uniform_open(words.y)), angle2 = fast_sine_cosine(uniform_open(words.w));
  Floats white = Floats(ping.reception.white);
  const uint at = ((2 * row + part) * blocks + block) * kNoiseBlock + i;
  white.at[at] = radius1 * angle1.cosine;
  white.at[at + kQuarter] = radius1 * angle1.sine;
  white.at[at + 2 * kQuarter] = radius2 * angle2.cosine;
  white.at[at + 3 * kQuarter] = radius2 * angle2.sine;
}
