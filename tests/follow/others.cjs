// Frames made by an encoder that others wrote: the npm package node-mavlink.
//
//   NODE_PATH=.../node_modules node others.cjs FILE VERSION     write a .tlog of version 1 or 2; 2 has a signed frame
//
// tests/data/telemetry/others-1.tlog and others-2.tlog are its output with node-mavlink 2.3.0.
// Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.
const fs = require('fs');
const { MavLinkProtocolV1, MavLinkProtocolV2, common } = require('node-mavlink');

const version = Number(process.argv[3]);
const protocol = version === 1 ? new MavLinkProtocolV1(1, 1) : new MavLinkProtocolV2(1, 1);
let sequence = 0, stamp = 1700000000000000n;
const parts = [];

function put(kind, fields, key) {
  const message = Object.assign(new kind(), fields);
  let frame = protocol.serialize(message, sequence++);
  if (key) {
    const signing = new MavLinkProtocolV2(1, 1, MavLinkProtocolV2.IFLAG_SIGNED);
    frame = signing.sign(signing.serialize(message, sequence - 1), 1, key, 1700000000000);
  }
  const time = Buffer.alloc(8);
  time.writeBigUInt64BE(stamp);
  stamp += 50000n;
  parts.push(time, frame);
}

for (let i = 0; i <= 40; i++) {
  const ms = 5000 + 100 * i, t = i / 10;
  put(common.Attitude, { timeBootMs: ms, roll: 0.1, pitch: -0.2, yaw: 0.5, rollspeed: 0, pitchspeed: 0, yawspeed: 0 });
  put(common.LocalPositionNed, { timeBootMs: ms, x: 3 + t, y: 2, z: 4, vx: 1, vy: 0, vz: 0 });
  if (i % 10 === 0) {
    put(common.GlobalPositionInt, { timeBootMs: ms, lat: 540000000, lon: 40000000 + i, alt: -4000, relativeAlt: -4000,
                                    vx: 0, vy: 0, vz: 0, hdg: 65535 });
    put(common.VfrHud, { airspeed: 0, groundspeed: 1, heading: 29, throttle: 40, alt: -4, climb: 0 });
    put(common.ScaledPressure2, { timeBootMs: ms, pressAbs: 1415.25, pressDiff: 0, temperature: 850,
                                  temperaturePressDiff: 0 });
    put(common.BatteryStatus, { id: 0, batteryFunction: 0, type: 1, temperature: 32767,
                                voltages: [4000, 4010, 3990, 4000, 65535, 65535, 65535, 65535, 65535, 65535],
                                currentBattery: 250, currentConsumed: 10, energyConsumed: -1, batteryRemaining: 77,
                                timeRemaining: 0, chargeState: 0, voltagesExt: [0, 0, 0, 0], mode: 0, faultBitmask: 0 });
    put(common.NamedValueFloat, { timeBootMs: ms, name: 'payout', value: 14 });
    put(common.NamedValueFloat, { timeBootMs: ms, name: 'tension_N', value: 12.5 },
        version === 2 && i === 20 ? Buffer.alloc(32, 7) : undefined);
  }
}
fs.writeFileSync(process.argv[2], Buffer.concat(parts));
