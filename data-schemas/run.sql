-- SPDX-License-Identifier: BSD-3-Clause
-- The run store: one SQLite file (.gonio) that keeps a sweep and every reading of it raw. Needs SQLite 3.37 (STRICT).
-- Angles are degrees of the sample frame (docs/conventions.md): zenith from the normal, azimuth counter-clockwise, both directions away
-- from the surface. Times are bench time in nanoseconds since the run's epoch, real or virtual (meta 'clock'); never the time of day.
-- Nothing is ever corrected or deleted here: what a reading means is decided when the run is reduced.
-- The opener sets journal_mode = WAL, synchronous = FULL and foreign_keys = ON, and commits each reading by itself.

PRAGMA application_id = 1735356009;  -- 'goni': how `file` and `gonio info` know a run store
PRAGMA user_version = 1;             -- version of this schema

-- Text pairs about the whole run: 'bench' and 'plan' (the JSON documents as they were read) with 'bench_sha256' and 'plan_sha256',
-- 'epoch_utc' (ISO 8601) and 'epoch_ns' (the same since 1970-01-01) of bench time 0, 'clock' (real or virtual), 'seed', 'simulated'.
CREATE TABLE meta (
  key   TEXT NOT NULL PRIMARY KEY,
  value TEXT NOT NULL
) STRICT, WITHOUT ROWID;

-- The plan, one row per step, written before anything moves. Masked and unreachable points are rows too, with their reason.
CREATE TABLE step (
  number       INTEGER NOT NULL PRIMARY KEY,             -- identity of the step in this run
  position     INTEGER NOT NULL UNIQUE,                  -- place in the planned order, from 0; not the order of the readings
  kind         TEXT    NOT NULL CHECK (kind IN ('sample', 'dark', 'reference')),
  theta_i_deg  REAL    NOT NULL,                         -- asked pose; the pose measured is in reading.axes_deg
  phi_i_deg    REAL    NOT NULL,
  theta_o_deg  REAL    NOT NULL,
  phi_o_deg    REAL    NOT NULL,                         -- absolute in the sample frame, not relative to phi_i_deg
  axes_deg     TEXT    NOT NULL CHECK (json_valid(axes_deg)),  -- JSON array: commanded angle of each axis [deg], bench order; [] unless ok
  exposure_s   REAL    NOT NULL CHECK (exposure_s > 0),  -- exposure of one reading [s]
  state        TEXT    NOT NULL CHECK (state IN ('ok', 'masked', 'unreachable')),
  reason       TEXT    NOT NULL CHECK ((reason = '') = (state = 'ok')),  -- why it is not measured
  rotation_deg REAL    NOT NULL,                         -- turn of the sample this point belongs to [deg]; already in the azimuths
  partner      INTEGER                                   -- number of the reciprocal partner, NULL for none
) STRICT;

-- Every reading of the detector, good or not, exactly as it came. A step is accepted when each repeat has a good reading;
-- the last good attempt counts. The kind of a reading is that of its step.
CREATE TABLE reading (
  number     INTEGER NOT NULL PRIMARY KEY,             -- order of taking
  step       INTEGER NOT NULL REFERENCES step (number),
  attempt    INTEGER NOT NULL CHECK (attempt >= 0),    -- 0 for the first try of the step
  repeat     INTEGER NOT NULL CHECK (repeat >= 0),     -- 0, 1, ... within one visit of the reference, else 0
  time_ns    INTEGER NOT NULL,                         -- bench time of the middle of the exposure [ns]
  signal_w   REAL    NOT NULL,                         -- as the meter printed it [W]; dark not subtracted
  exposure_s REAL    NOT NULL CHECK (exposure_s > 0),  -- exposure used [s]
  range_w    REAL    NOT NULL CHECK (range_w > 0),     -- range of the meter [W]
  counts     TEXT    NOT NULL CHECK (json_valid(counts)),    -- JSON array: position read back from each drive [counts], bench order
  axes_deg   TEXT    NOT NULL CHECK (json_valid(axes_deg)),  -- JSON array: the same in degrees; read back, not commanded
  good       INTEGER NOT NULL CHECK (good IN (0, 1)),  -- 0: saturated, out of position or otherwise refused
  reason     TEXT    NOT NULL CHECK ((reason = '') = (good = 1)),    -- why it was refused
  UNIQUE (step, attempt, repeat)
) STRICT;

-- What happened beside the readings: start, resume, stop, retry, device fault, warning.
CREATE TABLE event (
  number  INTEGER NOT NULL PRIMARY KEY,
  time_ns INTEGER NOT NULL,  -- bench time [ns]
  kind    TEXT    NOT NULL,  -- one word
  text    TEXT    NOT NULL   -- one sentence
) STRICT;

-- Values that turn readings into a BRDF and their uncertainty: the certificate of the reference and the lab's named components.
CREATE TABLE calibration (
  name   TEXT NOT NULL PRIMARY KEY,  -- e.g. 'reference_f', 'certificate'
  value  REAL NOT NULL,              -- in `unit`
  u      REAL CHECK (u > 0),         -- standard uncertainty, k = 1, in `unit`; NULL = unknown, never 0
  unit   TEXT NOT NULL,              -- '1/sr', '1' for a relative quantity, ...
  source TEXT NOT NULL               -- certificate, bench file, or the measurement it comes from
) STRICT, WITHOUT ROWID;
