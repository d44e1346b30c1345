# rubfric with everything it runs on, as pinned in environment.txt:
#   docker build -t rubfric .
#   docker run --rm --user "$(id -u):$(id -g)" -v "$PWD:/work" rubfric snakemake -j2 -s /rubfric/Snakefile --configfile mine.yaml
#   docker run --rm rubfric rubfric simulate --scale 1 --velocity 100 --pressure 5
FROM python:3.11-slim

WORKDIR /rubfric
COPY environment.txt .
RUN pip install --no-cache-dir --disable-pip-version-check -r environment.txt
COPY . .
RUN pip install --no-cache-dir --disable-pip-version-check --no-deps --no-build-isolation --editable .

# Whoever runs it owns what it writes: in /work, and caches in a home that any user may use.
ENV HOME=/tmp PYTHONDONTWRITEBYTECODE=1 OPENBLAS_NUM_THREADS=1
WORKDIR /work
USER nobody
CMD ["rubfric", "--help"]
