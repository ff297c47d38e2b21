"""The bill of materials of an archive: SPDX 2.3 in JSON, from what Debian's package data say of everything that was packed."""

from __future__ import annotations

from dataclasses import dataclass, field
from datetime import datetime, timezone
import hashlib
import json
from pathlib import Path
import re

from . import libraries, licences

# Libraries of headers, which leave no file of their own in the archive, by a file of each.
HEADERS = ["/usr/include/eigen3/Eigen/Core", "/usr/include/CLI/CLI.hpp", "/usr/include/toml++/toml.h", "/usr/include/boost/version.hpp"]
# What the page that `solidus report` writes is built from (web/report/package.json).
SCRIPTS = {"fflate": "MIT", "three": "MIT", "uplot": "MIT"}


@dataclass
class Component:
    """A package that is inside, in the words of SPDX."""

    name: str
    version: str
    licence: str
    download: str
    locator: str
    origin: str
    files: list[str] = field(default_factory=list)  # of the archive

    @property
    def identifier(self) -> str:
        return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.]+", "-", f"{self.origin}-{self.name}")


def debian_component(package: str, release: str) -> Component:
    """A package of Debian that is installed here. Its sources are kept for good at snapshot.debian.org.

    release : number of the release of Debian, for example "12"
    """
    about = libraries.properties(package)
    text = libraries.copyright_of(package).read_text(encoding="utf-8", errors="replace")
    return Component(about["name"], about["version"], licences.declared(text, about["name"]),
                     f"https://snapshot.debian.org/package/{about['source']}/{about['source_version']}/",
                     f"pkg:deb/debian/{about['name']}@{about['version']}?arch=amd64&distro=debian-{release}", "debian")


def script_components(manifest: Path) -> list[Component]:
    """What the viewer of reports is built from. Raises ``SystemExit`` for a dependency whose licence is not known here."""
    components = []
    for name, version in sorted(json.loads(manifest.read_text())["dependencies"].items()):
        if name not in SCRIPTS:
            raise SystemExit(f"{manifest}: the licence of '{name}' is not in python/solidus_release/bill_of_materials.py")
        components.append(Component(name, version, SCRIPTS[name], f"https://registry.npmjs.org/{name}/-/{name}-{version}.tgz",
                                    f"pkg:npm/{name}@{version}", "npm"))
    return components


def _package(component: Component) -> dict:
    package = {
        "SPDXID": component.identifier, "name": component.name, "versionInfo": component.version,
        "downloadLocation": component.download, "filesAnalyzed": False, "licenseConcluded": "NOASSERTION",
        "licenseDeclared": component.licence, "copyrightText": "NOASSERTION",
        "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": component.locator}],
    }
    if component.files:
        package["comment"] = "in the archive: " + " ".join(sorted(component.files))
    return package


def document(version: str, components: list[Component], epoch: int) -> str:
    """The bill as JSON text.

    version : of Solidus
    epoch : seconds since 1970 that it is dated with
    """
    components = sorted(components, key=lambda component: component.identifier)
    names = set().union(*(licences.references(component.licence) for component in components))
    body = [_package(component) for component in components]
    digest = hashlib.sha256(json.dumps(body, sort_keys=True).encode()).hexdigest()[:16]
    archive = {"SPDXID": "SPDXRef-solidus", "name": "solidus", "versionInfo": version, "downloadLocation": "NOASSERTION",
               "filesAnalyzed": False, "licenseConcluded": "NOASSERTION", "licenseDeclared": "BSD-3-Clause",
               "copyrightText": "NOASSERTION", "primaryPackagePurpose": "APPLICATION"}
    relations = [{"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES", "relatedSpdxElement": "SPDXRef-solidus"}]
    relations += [{"spdxElementId": "SPDXRef-solidus", "relationshipType": "CONTAINS", "relatedSpdxElement": component.identifier}
                  for component in components]
    explained = [{"licenseId": name, "name": name.removeprefix("LicenseRef-"),
                  "extractedText": "As the copyright files of the packages that name it state it: share/licences/PACKAGE in the archive."}
                 for name in sorted(names)]
    return json.dumps({
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"solidus-{version}",
        "documentNamespace": f"https://spdx.org/spdxdocs/solidus-{version}-{digest}",
        "creationInfo": {"created": datetime.fromtimestamp(epoch, timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
                         "creators": ["Tool: solidus_release"]},
        "packages": [archive, *body], "relationships": relations, "hasExtractedLicensingInfos": explained,
    }, indent=1, ensure_ascii=False) + "\n"
