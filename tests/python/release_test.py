"""What is handed out: licences in the words of SPDX, a bill of materials, notes, archives of the same bytes."""

import io
import json
import os
from pathlib import Path
import re
import shutil
import tempfile
import unittest
from unittest import mock

from solidus_release import archive, bill_of_materials, licences, notes
from solidus_release.__main__ import checksums, fill

ROOT = Path(__file__).resolve().parents[2]
VERSION = re.search(r"project\(solidus VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]

COPYRIGHT = """Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/

Files: *
Copyright: 1999 Somebody
License: GPL-2+ or Expat

Files: src/table.c
 src/other.c
Copyright: 2001 Another
License: BSD-3-clause and Zlib

Files: debian/* debian/rules
Copyright: 2010 A Packager
License: GPL-3+

License: BSD-3-clause
 The text of it.
"""


class Licences(unittest.TestCase):
    def test_names_of_debian_become_those_of_spdx(self):
        for debian, spdx in (("Expat", "MIT"), ("GPL-2+", "GPL-2.0-or-later"), ("LGPL-2.1", "LGPL-2.1-only"), ("Apache-2.0", "Apache-2.0"),
                             ("GPL-2+ or Expat", "GPL-2.0-or-later OR MIT"), ("CeCILL-C", "CECILL-C"),
                             ("GPL-2 with Gmsh exception", "LicenseRef-GPL-2-with-Gmsh-exception"),
                             ("Expat and Zlib or ISC", "(MIT AND Zlib) OR ISC")):
            self.assertEqual(licences.expression(debian), spdx)

    def test_what_concerns_the_packaging_alone_is_left_out(self):
        self.assertEqual(licences.declared(COPYRIGHT, "table"), "BSD-3-Clause AND (GPL-2.0-or-later OR MIT) AND Zlib")

    def test_a_file_in_another_form_is_referred_to_as_a_whole(self):
        said = licences.declared("This package was made by hand.\nIts licence is long.\n", "libold+2")
        self.assertEqual(said, "LicenseRef-libold-2")
        self.assertEqual(licences.references(f"MIT AND {said}"), {"LicenseRef-libold-2"})


class Bill(unittest.TestCase):
    COMPONENTS = [bill_of_materials.Component("libb", "2:1.0-1", "MIT", "https://b", "pkg:deb/debian/libb@1", "debian", ["lib/b", "lib/a"]),
                  bill_of_materials.Component("liba", "1", "LicenseRef-Own", "https://a", "pkg:deb/debian/liba@1", "debian")]

    def test_it_names_every_component_once_and_explains_what_spdx_does_not_know(self):
        bill = json.loads(bill_of_materials.document("9.8.7", self.COMPONENTS, 86400))
        self.assertEqual([(package["name"], package["versionInfo"]) for package in bill["packages"]],
                         [("solidus", "9.8.7"), ("liba", "1"), ("libb", "2:1.0-1")])
        self.assertEqual([one["licenseId"] for one in bill["hasExtractedLicensingInfos"]], ["LicenseRef-Own"])
        self.assertEqual(bill["creationInfo"]["created"], "1970-01-02T00:00:00Z")
        identifiers = {package["SPDXID"] for package in bill["packages"]}
        self.assertEqual(len(identifiers), 3)
        for relation in bill["relationships"]:
            self.assertIn(relation["relatedSpdxElement"], identifiers)
        for package in bill["packages"]:
            self.assertLessEqual({"SPDXID", "name", "downloadLocation", "filesAnalyzed", "licenseConcluded", "licenseDeclared",
                                  "copyrightText"}, set(package))
        self.assertIn("lib/a lib/b", bill["packages"][2]["comment"])

    def test_the_order_in_which_components_are_found_does_not_matter(self):
        one, other = (bill_of_materials.document("1", list(order), 0) for order in (self.COMPONENTS, reversed(self.COMPONENTS)))
        self.assertEqual(one, other)

    def test_every_script_of_the_report_has_its_licence(self):
        names = {component.name for component in bill_of_materials.script_components(ROOT / "web/report/package.json")}
        self.assertEqual(names, set(json.loads((ROOT / "web/report/package.json").read_text())["dependencies"]))


class Notes(unittest.TestCase):
    def test_the_version_of_the_tree_has_notes_and_a_part_of_the_changelog(self):
        self.assertEqual(notes.missing(VERSION), [])

    def test_what_a_version_lacks_is_said(self):
        said = notes.missing("9.9.9")
        self.assertEqual(len(said), 2)
        self.assertIn("docs/releases/9.9.9.md is missing", said[0])
        self.assertIn("## 9.9.9", said[1])

    def test_the_part_of_a_version_ends_where_the_next_begins(self):
        text = "# Changelog\n## Unreleased\n- a\n\n## 0.2.0 - 2026-11-29\n- b\n\n### c\n- d\n\n## 0.1.0 - 2026-11-21\n- e\n"
        self.assertEqual(notes.part_of_changelog(text, "0.2.0"), "- b\n\n### c\n- d")
        self.assertEqual(notes.part_of_changelog(text, "0.1.0"), "- e")
        self.assertEqual(notes.part_of_changelog(text, "0.2"), "")

    def test_the_version_stands_in_one_place(self):
        self.assertNotRegex((ROOT / "CITATION.cff").read_text(), r"(?m)^version:")
        self.assertNotIn(VERSION, (ROOT / "pyproject.toml").read_text())


class Folder(unittest.TestCase):
    """What a release is made of, with a build that has packages of one Debian and a program that says its version."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.version = f"{VERSION}+20261129.0123456"
        (self.folder / "build/packages").mkdir(parents=True)
        (self.folder / "build/packages" / f"solidus_{self.version}-1~deb13_amd64.deb").write_text("thirteen")
        program = self.folder / "build/solidus"
        program.write_text(f"#!/bin/sh\necho Solidus {self.version}\n")
        program.chmod(0o755)
        self.place = self.folder / "releases" / self.version

    def fill(self, number):
        system = {"ID": "debian", "VERSION_ID": number, "PRETTY_NAME": f"Debian {number}"}
        with mock.patch("platform.freedesktop_os_release", return_value=system), \
                mock.patch("solidus_release.archive.make_tree", return_value="bill") as make_tree, \
                mock.patch("solidus_release.archive.compress", lambda tree, file, epoch: file.write_text("packed")), \
                mock.patch("sys.stderr", io.StringIO()) as said:
            make_tree.side_effect = lambda build, tree, *rest: tree.mkdir() or "bill"
            made = fill(self.folder / "build", self.folder / "releases", 86400)
        self.assertEqual(made, self.place)
        return sorted(file.name for file in made.iterdir()), said.getvalue()

    def test_it_is_called_as_the_version_and_takes_packages_of_another_debian_that_lie_there(self):
        self.place.mkdir(parents=True)
        (self.place / f"solidus_{self.version}-1~deb12_amd64.deb").write_text("twelve")
        names, said = self.fill("13")
        self.assertEqual(names, sorted(["SHA256SUMS", f"solidus-{self.version}-notes.md", f"solidus_{self.version}-1~deb12_amd64.deb",
                                        f"solidus_{self.version}-1~deb13_amd64.deb"]))
        self.assertIn(f"no archive: it is made on Debian {archive.DEBIAN}, and this is Debian 13", said)
        self.assertEqual([line.split("  ")[1] for line in (self.place / "SHA256SUMS").read_text().splitlines()],
                         [name for name in names if name != "SHA256SUMS"])

    def test_the_archive_is_made_on_one_release_of_debian(self):
        names, said = self.fill(archive.DEBIAN)
        self.assertEqual(said, "")
        self.assertLessEqual({f"solidus-{self.version}-x86_64.tar.zst", f"solidus-{self.version}-x86_64.spdx.json"}, set(names))

    def test_packages_of_another_version_are_not_handed_out_with_it(self):
        self.place.mkdir(parents=True)
        for place in (self.place, self.folder / "build/packages"):
            for name in (f"solidus_{VERSION}+20261128.fedcba9-1~deb12_amd64.deb", "something.deb"):
                (place / name).write_text("old")
                with self.assertRaisesRegex(SystemExit, "is of another version"):
                    self.fill("12")
                (place / name).unlink()


class Archives(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    @unittest.skipIf(shutil.which("zstd") is None, "zstd is not installed")
    def test_the_same_files_give_the_same_bytes_whenever_and_in_whatever_order_they_were_written(self):
        archives = []
        for names, date, mask in ((("a", "b", "sub/c"), 1e9, 0o022), (("sub/c", "b", "a"), 1.5e9, 0o077)):
            tree = self.folder / str(len(archives)) / "tree"
            before = os.umask(mask)
            for name in names:
                (tree / name).parent.mkdir(parents=True, exist_ok=True)
                (tree / name).write_text(name * 1000)
                os.utime(tree / name, (date, date))
            os.umask(before)
            archives.append(self.folder / f"{len(archives)}.tar.zst")
            archive.compress(tree, archives[-1], 86400)
        self.assertEqual(archives[0].read_bytes(), archives[1].read_bytes())

    def test_names_of_one_library_share_a_file(self):
        for name, text in (("libx.so.1", "x"), ("libx.so.1.2", "x"), ("liby.so", "y")):
            (self.folder / name).write_text(text)
        archive.share_equal_files(self.folder)
        self.assertEqual((self.folder / "libx.so.1.2").readlink(), Path("libx.so.1"))
        self.assertFalse((self.folder / "liby.so").is_symlink())

    def test_components_of_open_mpi_for_networks_and_batch_systems_stay_behind(self):
        for name in ("btl_vader", "btl_self", "btl_openib", "btl_ofi", "pml_ob1", "pml_ucx", "mtl_psm2", "plm_isolated", "plm_slurm", "plm_rsh"):
            (self.folder / f"mca_{name}.so").touch()
        self.assertEqual([file.stem for file in archive.open_mpi_components(self.folder)],
                         ["mca_btl_self", "mca_btl_vader", "mca_plm_isolated", "mca_pml_ob1"])

    def test_checksums_are_those_that_sha256sum_checks(self):
        (self.folder / "b").write_text("")
        (self.folder / "a").write_text("text")
        (self.folder / "SHA256SUMS").write_text("old")
        lines = checksums(self.folder).splitlines()
        self.assertEqual([line.split("  ")[1] for line in lines], ["a", "b"])
        self.assertTrue(lines[1].startswith("e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"))


if __name__ == "__main__":
    unittest.main()
