"""The rotorstab dashboard: `panel serve app`.

Each open page has a `session`: the `state` of its inputs, the `results` that follow from them,
`words` about the results, `live` charts and `background` work. `pages` arrange them and `exports`
write them to files.
"""
