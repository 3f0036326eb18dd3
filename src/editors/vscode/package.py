#!/usr/bin/env python3
"""package.py GRAMMAR OUT.vsix: packs the extension with the generated grammar. `npm run bundle` must run first. The
output is reproducible."""

import json
import subprocess
import sys
import zipfile
from pathlib import Path
from xml.sax.saxutils import quoteattr, escape

here = Path(__file__).resolve().parent
about = json.loads((here / "package.json").read_text())
about.update(json.loads(subprocess.run([here / "../../packaging/fill.sh", here / "identity.json"], check=True,
                                       stdout=subprocess.PIPE).stdout))
for only_for_building in ("dependencies", "devDependencies", "scripts", "private"):
    about.pop(only_for_building)
MANIFEST = f"""<?xml version="1.0" encoding="utf-8"?>
<PackageManifest Version="2.0.0" xmlns="http://schemas.microsoft.com/developer/vsx-schema/2011">
<Metadata>
<Identity Language="en-US" Id={quoteattr(about["name"])} Version={quoteattr(about["version"])} Publisher={quoteattr(about["publisher"])}/>
<DisplayName>{escape(about["displayName"])}</DisplayName>
<Description>{escape(about["description"])}</Description>
<Categories>{escape(",".join(about["categories"]))}</Categories>
<Properties><Property Id="Microsoft.VisualStudio.Code.Engine" Value={quoteattr(about["engines"]["vscode"])}/></Properties>
</Metadata>
<Installation><InstallationTarget Id="Microsoft.VisualStudio.Code"/></Installation>
<Dependencies/>
<Assets>
<Asset Type="Microsoft.VisualStudio.Code.Manifest" Path="extension/package.json" Addressable="true"/>
<Asset Type="Microsoft.VisualStudio.Services.Content.Details" Path="extension/README.md" Addressable="true"/>
</Assets>
</PackageManifest>
"""
TYPES = """<?xml version="1.0" encoding="utf-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension=".json" ContentType="application/json"/><Default Extension=".js" ContentType="application/javascript"/>
<Default Extension=".md" ContentType="text/markdown"/><Default Extension=".vsixmanifest" ContentType="text/xml"/>
</Types>
"""
files = {
    "extension.vsixmanifest": MANIFEST.encode(),
    "[Content_Types].xml": TYPES.encode(),
    "extension/package.json": json.dumps(about, indent=2).encode(),
    "extension/flitter.tmLanguage.json": Path(sys.argv[1]).read_bytes(),
    **{"extension/" + name: (here / name).read_bytes()
       for name in ("README.md", "language-configuration.json", "dist/extension.js")},
}
with zipfile.ZipFile(sys.argv[2], "w", zipfile.ZIP_DEFLATED) as archive:
    for name, data in files.items():
        archive.writestr(zipfile.ZipInfo(name, (2026, 1, 1, 0, 0, 0)), data, zipfile.ZIP_DEFLATED)
