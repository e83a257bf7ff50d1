"""The rotorstab dashboard: `panel serve app`."""
