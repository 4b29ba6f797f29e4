# regscribe's command line in a container: docs/ci.md. Serial lines come in with --device.
FROM python:3.12-slim AS build
COPY . /source
RUN pip wheel --no-cache-dir --wheel-dir /wheels /source/generator/runtime /source/generated /source
RUN python -m venv /opt/regscribe
RUN /opt/regscribe/bin/pip install --no-cache-dir --no-index --find-links /wheels regscribe

FROM python:3.12-slim
LABEL org.opencontainers.image.title="regscribe" \
      org.opencontainers.image.description="A register-map compiler for Modbus: drivers, docs, test vectors and a simulator" \
      org.opencontainers.image.licenses="MIT"
COPY --from=build /opt/regscribe /opt/regscribe
# dialout owns the serial ports of Debian's hosts; for another group: docker run --group-add
RUN useradd --create-home --groups dialout regscribe
ENV PATH=/opt/regscribe/bin:$PATH
USER regscribe
WORKDIR /work
ENTRYPOINT ["regscribe"]
CMD ["--help"]
