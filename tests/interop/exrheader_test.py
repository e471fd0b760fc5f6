# SPDX-License-Identifier: BSD-3-Clause
"""OpenEXR's own exrheader reads the images gonio writes."""

import interop


class Exrheader(interop.TestCase):
    def test_parts_of_a_table(self):
        exrheader = interop.program("exrheader")
        samples = self.folder / "samples.csv"
        rows = [f"{i},0,{o},180,{0.1 + o / 1000},0.001" for i in (10, 30) for o in range(0, 81, 20)]
        samples.write_text("theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value,u_value\n" + "\n".join(rows) + "\n")
        table = self.folder / "table.brdf.exr"
        interop.gonio("export", samples, "--to", "brdf-exr", "--out", table)
        header = interop.run(exrheader, table)
        for part in ("value", "uncertainty", "count", "incident", "outgoing"):
            self.check(f'name (type string): "{part}"' in header, f"part {part} in\n{header}")
        self.check("dataWindow (type box2i): (0 0) - (4 1)" in header, f"2 incident by 5 outgoing directions in\n{header}")

    def test_a_damaged_file_is_seen(self):
        exrheader = interop.program("exrheader")
        broken = self.folder / "broken.exr"
        broken.write_bytes(b"\x76\x2f\x31\x01 and then something else")
        done = interop.run(exrheader, broken, check=False)
        self.check(done.returncode != 0 or "rror" in done.stderr + done.stdout, "exrheader refuses what is no image")


interop.main()
