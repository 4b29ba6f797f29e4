"""What headings of register lists mean, in the habits of several languages."""

import re
import unicodedata
from collections.abc import Mapping

AT = "at"
IGNORE = "-"
"""What `--columns` says of a column that is not to be read."""

ROLES: Mapping[str, str] = {
    AT: "address",
    "name": "name",
    "type": "data type",
    "length": "size",
    "access": "access",
    "scale": "scale",
    "offset": "offset",
    "decimals": "decimal places",
    "unit": "unit",
    "range": "range",
    "min": "lowest value",
    "max": "highest value",
    "default": "default",
    "values": "codes and labels",
    "bits": "bits and labels",
    "bit": "number of a bit",
    "space": "address space or function",
    "word_order": "order of words",
    "description": "description",
    "symbol": "short code",
    "group": "group",
    "section": "section of the manual",
}
"""What a column can say, by the word that `--columns` takes, with what the proposal calls it."""

SEVERAL = frozenset({AT, "description", "values"})
"""What several columns can say together: addresses in two notations, remarks beside a description."""

_WORDS: Mapping[str, str] = {  # each list from the plainest word to the one that may mean something else
    AT: "address | addr | adr | register | reg | register address | reg address | modbus address | "
    "modbus register | modbus reg | modbus addr | register number | register no | register nr | reg no | "
    "reg nr | start address | starting address | start register | wire address | pdu address | pdu | "
    "data address | protocol address | plc address | modicon address | holding register | input register | "
    "address dec | dec address | decimal address | address hex | hex address | address decimal | "
    "address hexadecimal | dec | hex | register dec | register hex | offset address | address offset | adresse | "
    "registeradresse | modbus adresse | modbusadresse | registernummer | register nummer | startadresse | "
    "adresse dez | adresse hex | adresse modbus | registre | numero de registre | adresse registre | "
    "adresse du registre | indirizzo | indirizzo modbus | registro | indirizzo registro | numero registro | "
    "direccion | direccion modbus | direccion de registro | direccion registro | adres | modbusadres | "
    "modbus adres | registeradres | adress | modbusadress | modbus adress | registeradress | adres rejestru | "
    "rejestr | adres modbus | numer rejestru | 地址 | 寄存器地址 | 寄存器 | 起始地址 | 通讯地址 | modbus地址 | "
    "协议地址 | coil | coil address | coil number | discrete input | input address | modbus id | ref | reference | id",
    "name": "name | parameter | parameter name | variable | variable name | register name | data name | "
    "signal | signal name | point | point name | data point | datapoint | title | label | tag | tag name | "
    "item | object | parameters | quantity | measurement | content | contents | register description | "
    "bezeichnung | benennung | datenpunkt | messwert | messgrosse | variablenname | registername | nom | "
    "libelle | designation | parametre | grandeur | variable nom | nome | parametro | denominazione | "
    "grandezza | variabile | nombre | variable nombre | magnitud | naam | parameternaam | "
    "omschrijving register | benaming | namn | benamning | nazwa | nazwa parametru | parametr | 名称 | 参数 | "
    "参数名称 | 信号名称 | 变量名 | 参数名 | 数据名称",
    "type": "type | data type | datatype | format | data format | register type data | value type | "
    "variable type | reg type | encoding | representation | signed | typ | datentyp | datenformat | datentype | "
    "zahlenformat | type de donnees | type de donnee | format de donnees | tipo | tipo dati | tipo dato | "
    "tipo di dato | formato | tipo de dato | tipo de datos | gegevenstype | datatyp | typ danych | "
    "format danych | 数据类型 | 类型 | 格式 | 数据格式",
    "length": "length | size | words | word count | number of registers | number of words | registers | "
    "no of registers | nr of registers | num registers | register count | reg count | quantity of registers | "
    "count | len | bytes | bits size | number of regs | nb registers | size words | length words | max length | "
    "size of variable | lange | laenge | anzahl register | registeranzahl | grosse | anzahl worte | anzahl | "
    "longueur | taille | nombre de registres | nombre de mots | nb de mots | nb mots | lunghezza | dimensione | "
    "numero registri | numero di registri | longitud | tamano | numero de registros | numero de palabras | "
    "lengte | aantal registers | aantal | langd | storlek | antal register | antal | dlugosc | rozmiar | "
    "liczba rejestrow | 长度 | 寄存器数量 | 字数 | 寄存器个数 | 数量",
    "access": "access | r w | rw | read write | access type | access rights | access mode | access code | "
    "mode | permission | permissions | rights | attribute | writable | writeable | write | read only | "
    "access level | rw access | rw access rw | action | attributes | property | zugriff | lesen schreiben | "
    "zugriffsart | zugriffsrecht | schreibbar | l s | acces | lecture ecriture | l e | droits | accesso | "
    "lettura scrittura | acceso | lectura escritura | toegang | lezen schrijven | atkomst | las skriv | "
    "lasa skriva | dostep | odczyt zapis | 读写 | 访问 | 权限 | 读写属性 | 属性 | 读 写",
    "scale": "scale | scaling | factor | scale factor | scalefactor | scaling factor | multiplier | "
    "multiplicator | gain | divisor | divider | division factor | resolution | sf | coefficient | conversion | "
    "scale x | lsb | increment | magnification | faktor | skalierung | "
    "skalierungsfaktor | aufloesung | auflosung | teiler | multiplikator | facteur | echelle | "
    "facteur d echelle | mise a l echelle | multiplicateur | diviseur | fattore | scala | fattore di scala | "
    "moltiplicatore | divisore | risoluzione | escala | factor de escala | multiplicador | resolucion | schaal | "
    "schaalfactor | vermenigvuldiger | skala | skalfaktor | skalning | upplosning | mnoznik | wspolczynnik | "
    "dzielnik | 系数 | 比例 | 倍率 | 比例系数 | 精度 | 缩放 | 增益 | 分辨率",
    "offset": "offset | value offset | bias | zero offset | nullpunkt | decalage | scostamento | "
    "desplazamiento | przesuniecie | 偏移 | 偏移量",
    "decimals": "decimals | decimal places | decimal | digits | dp | dec places | decimal point | "
    "number of decimals | decimal digits | nachkommastellen | dezimalstellen | kommastellen | nachkomma | "
    "decimales | nombre de decimales | decimali | cifre decimali | decimalen | decimaler | miejsca dziesietne | "
    "小数位 | 小数位数 | 小数点",
    "unit": "unit | units | uom | unit of measure | unit of measurement | eng unit | engineering unit | "
    "measurement unit | einheit | masseinheit | einheiten | unite | unites | unita | unita di misura | u m | "
    "um | unidad | unidades | eenheid | enhet | jednostka | jednostki | jm | 单位",
    "range": "range | value range | valid range | limits | values range | allowed range | data range | "
    "setting range | scope | min max | min to max | range min max | bereich | wertebereich | einstellbereich | plage | "
    "plage de valeurs | plage de reglage | intervallo | campo | campo di valori | gamma | range valori | rango | "
    "intervalo | rango de valores | bereik | waardebereik | omrade | vardeomrade | intervall | zakres | "
    "zakres wartosci | 范围 | 取值范围 | 数据范围 | 设定范围",
    "min": "min | minimum | min value | minimum value | minimal value | low limit | lower limit | low | "
    "lowest | from | minimalwert | mindestwert | von | valeur min | minimo | valore minimo | min wert | minsta | "
    "wartosc min | 最小值 | 最小 | 下限",
    "max": "max | maximum | max value | maximum value | maximal value | high limit | upper limit | high | "
    "highest | to | maximalwert | hochstwert | bis | valeur max | massimo | valore massimo | maximo | max wert | "
    "storsta | wartosc max | 最大值 | 最大 | 上限",
    "default": "default | default value | factory default | factory setting | factory value | "
    "initial value | factory settings | initial | preset | def | vorgabe | werkseinstellung | standardwert | "
    "standard | voreinstellung | vorgabewert | valeur par defaut | defaut | par defaut | reglage usine | "
    "valeur usine | predefinito | valore predefinito | valore di default | valor por defecto | por defecto | "
    "valor de fabrica | standaard | standaardwaarde | fabrieksinstelling | standardvarde | fabriksinstallning | "
    "domyslna | wartosc domyslna | 默认值 | 默认 | 出厂值 | 初始值 | 缺省值",
    "values": "values | enum | enumeration | options | states | meaning | possible values | allowed values | "
    "value meaning | codes | coding | choices | value list | value description | value | valid values | "
    "data description | werte | bedeutung | auswahl | wert | wertetabelle | mogliche werte | valeurs | valeur | "
    "signification | codes valeurs | valeurs possibles | valori | significato | valore | valores | significado | "
    "waarden | betekenis | varden | betydelse | wartosci | znaczenie | wartosc | 值 | 枚举 | 取值 | 含义 | 选项",
    "bits": "bits | bit meaning | bit description | flags | bitfield | bit field | bit assignment | "
    "bitbelegung | bitmask",
    "bit": "bit | bit no | bit nr | bit number | bit position | bit index | 位",
    "space": "space | function | function code | fc | func | function codes | register type | modbus type | "
    "table | modbus function | object type | area | memory area | register kind | data table | modbus table | "
    "fn | modbus function code | register class | fcode | funktion | funktionscode | funktionscodes | "
    "registertyp | registerart | registertype | fonction | code fonction | code de fonction | type de registre | "
    "funzione | codice funzione | tipo registro | tipo di registro | funcion | codigo de funcion | "
    "codigo funcion | tipo de registro | functie | functiecode | funktionskod | funkcja | kod funkcji | "
    "typ rejestru | 功能码 | 功能 | 寄存器类型",
    "word_order": "word order | byte order | endian | endianness | endianess | order | wortreihenfolge | "
    "bytereihenfolge | ordre des mots | swap | 字节序 | 字序",
    "description": "description | comment | comments | remark | remarks | note | notes | explanation | "
    "info | details | information | help | function description | desc | additional information | beschreibung | "
    "bemerkung | bemerkungen | kommentar | hinweis | erlauterung | anmerkung | beschrieb | commentaire | "
    "commentaires | remarque | remarques | observation | observations | descrizione | commento | osservazioni | "
    "descripcion | comentario | comentarios | observaciones | notas | beschrijving | omschrijving | opmerking | "
    "opmerkingen | toelichting | beskrivning | kommentarer | anmarkning | forklaring | opis | uwagi | "
    "komentarz | 描述 | 说明 | 备注 | 注释",
    "symbol": "symbol | short name | mnemonic | abbreviation | code | parameter code | parameter no | "
    "parameter number | par | par no | kurzel | kurzzeichen | abk | symbole | abreviation | simbolo | sigla | "
    "codice | codigo | skrot | symbool | 符号 | 代码 | 代号 | 参数代码",
    "group": "group | category | block | menu | module | section name | class | subsystem | component | "
    "chapter name | gruppe | kategorie | baugruppe | menue | groupe | categorie | gruppo | categoria | grupo | "
    "groep | grupp | grupa | kategoria | 分组 | 组 | 分类 | 类别",
    "section": "section | chapter | page | manual section | kapitel | abschnitt | seite | chapitre | "
    "page manuel | capitolo | pagina | capitulo | hoofdstuk | rozdzial | 章节",
}

PLAIN = re.compile(r"[^\W_]+|%")
BRACKETED = re.compile(r"[(\[][^)\]]*[)\]]")


def fold(heading: str) -> str:
    """A heading in lower case without accents, its words separated by one blank."""
    text = unicodedata.normalize("NFKD", heading.casefold())
    return " ".join(PLAIN.findall("".join(char for char in text if not unicodedata.combining(char))))


MEANINGS: dict[str, tuple[str, int]] = {}
"""What each folded heading means, and how far from the plainest word for it; the first of `ROLES` has a word of two."""
for _role in ROLES:
    for _rank, _word in enumerate(_WORDS[_role].split(" | ")):
        MEANINGS.setdefault(fold(_word), (_role, _rank))

FIRST = ("min", "minimum", "max", "maximum", "default", "unit", "bit")
"""Words that decide, wherever they stand in a longer heading: `range, min`; `unit of the value`."""

GENERAL = frozenset({"register", "registers", "registre", "registro", "rejestr", "reg", "dec", "hex", "寄存器"})
"""Words that say little beside others: a `register length` is a length."""

PARTS = (
    *FIRST,
    *sorted((word for word in MEANINGS if len(word) > 2), key=lambda word: (word in GENERAL, -len(word), word)),  # noqa: PLR2004 - `r w` is no word
)
"""Words that count inside longer headings too: the first ones, the longest first, the general ones at the end."""

INSIDE = 1000
"""How much less sure a heading is that is not known as a whole."""


def meaning(heading: str) -> tuple[str, int]:
    """What a heading means, empty if that is not known; with it how unsure that is (0: the plainest word for it)."""
    whole = fold(heading)
    for text in (whole, fold(BRACKETED.sub(" ", heading))):
        if text in MEANINGS:
            return MEANINGS[text]
    inside = f" {whole} "
    for word in PARTS:
        if f" {word} " in inside or (not word.isascii() and word in whole):
            role, rank = MEANINGS[word]
            return role, rank + INSIDE
    return "", 0
