# SPDX-License-Identifier: Zlib
from cairn._builder import (
    Cover as Cover,
    EnclosedDistance as EnclosedDistance,
    LevelCertificate as LevelCertificate,
    LevelFit as LevelFit,
    SpheresCertificate as SpheresCertificate,
    TreeCertificate as TreeCertificate,
    TriangleMesh as TriangleMesh,
    build as build,
    certify as certify,
    cover as cover,
    evaluate as evaluate,
    export as export,
    load_mesh as load_mesh,
)
from cairn._core import Error as Error, SphereTree as SphereTree, __version__ as __version__, load as load

has_builder: bool
