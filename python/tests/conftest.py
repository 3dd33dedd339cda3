"""Where the fixtures are, and a cache of models for this run alone."""

from __future__ import annotations

from pathlib import Path

import pytest

import fogcoil

FIXTURES = Path(__file__).resolve().parents[2] / "fixtures"


@pytest.fixture(scope="session", autouse=True)
def own_cache(tmp_path_factory: pytest.TempPathFactory) -> object:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("FOGCOIL_CACHE", str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture(scope="session")
def fixtures() -> Path:
    return FIXTURES


@pytest.fixture(scope="session")
def coil() -> fogcoil.Coil:
    return fogcoil.Coil(FIXTURES / "coil-reference.ron")
